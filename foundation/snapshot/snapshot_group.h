/// @file snapshot_group.h
/// The elements of one kind that one solver of one instance published.
#pragma once

#include "foundation/math/geometry.h"
#include "foundation/memory/column.h"
#include "foundation/snapshot/snapshot_schema.h"
#include "foundation/time/ticks.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <memory_resource>
#include <span>
#include <utility>
#include <vector>

namespace fx::base {

/// Identity, size, placement and bounds of a group.
struct GroupInfo
{
    KindId kind = 0;
    uint64_t instance = 0; ///< identity of the instance within the scene
    uint32_t solver = 0;   ///< index of the solver in its effect
    uint32_t count = 0;    ///< number of elements
    Placement placement;   ///< transform from the local space, in which positions in columns are given
    Bounds bounds; ///< bounds in the local space of the placement; they contain every element with its radius
    Ticks step = 0; ///< [tick] local time of the instance that passed in the step of the snapshot
    /// True: the snapshot's hash does not include this group, because the group may be computed on the GPU.
    bool isCosmetic = false;
    /// True: the rows are computed when they are first read, see FrameSnapshot::addLateGroup().
    bool isLate = false;
    /// True: the placement does not follow the instance, so a placement shown for the instance does not
    /// apply.
    bool staysInWorld = false;
};

class GpuParticleProgram;

/// Number of floats in the storage of `capacity` elements with the columns `present` of a kind.
size_t floatsFor(const KindDesc& kind, size_t capacity, ColumnSet present);

/// One group: column-wise elements, sorted by ascending id where the kind has ids. The columns that the group
/// has are stored one after another, in the order of the kind. Each column begins at a multiple of 64 bytes
/// and has room for capacity() elements, rounded up to 64 bytes.
class SnapshotGroup
{
public:
    SnapshotGroup(std::pmr::memory_resource* memory) : memory_(memory), ids_(memory) {}

    const GroupInfo& info() const { return info_; }
    uint32_t count() const { return info_.count; }
    /// Ids of the elements; empty when the kind has no ids.
    std::span<const uint64_t> ids() const { return {ids_.data(), hasIds_ ? info_.count : 0}; }
    /// Column `index` of the kind, which must have the type F32; empty if the group does not have this
    /// column.
    std::span<const float> column(size_t index) const { return {place(index), has(index) ? info_.count : 0}; }
    /// Column `index` of the kind, which must have the type U64; empty if the group does not have this
    /// column.
    std::span<const uint64_t> column64(size_t index) const
    {
        return {reinterpret_cast<const uint64_t*>(place(index)), has(index) ? info_.count : 0};
    }
    bool has(size_t index) const { return (present_ >> index & 1) != 0; }
    ColumnSet present() const { return present_; }
    /// Pointer to the first element of a column of floats. The pointer is valid even if count() is 0.
    const float* start(size_t index) const { return place(index); }
    std::span<const float> constants() const { return {constants_.data(), constantCount_}; }
    /// Program of a group of the kind "gpuParticle", see gpu_particles.h; null for other kinds.
    const std::shared_ptr<const GpuParticleProgram>& program() const { return program_; }

    // ---- for the writer, before publication ----
    GroupInfo& editInfo() { return info_; }
    std::span<uint64_t> editIds() { return {ids_.data(), hasIds_ ? capacity_ : 0}; }
    std::span<float> editColumn(size_t index)
    {
        return {const_cast<float*>(place(index)), has(index) ? capacity_ : 0};
    }
    std::span<uint64_t> editColumn64(size_t index)
    {
        return {reinterpret_cast<uint64_t*>(const_cast<float*>(place(index))), has(index) ? capacity_ : 0};
    }
    void setProgram(std::shared_ptr<const GpuParticleProgram> program) { program_ = std::move(program); }
    std::span<float> editConstants() { return {constants_.data(), constantCount_}; }
    /// Storage of all columns of the group.
    float* editStorage() { return storage_.data(); }
    size_t capacity() const { return capacity_; }
    /// True when the group still has the constants that `writer` wrote. Then the constants need not be
    /// written again. When the function returns false, the constants are zero and must be written.
    /// @param writer number that identifies the constants, not 0; in a process, different constants have
    ///         different numbers
    bool keepsConstants(uint64_t writer)
    {
        if (constantsWriter_ == writer)
            return true;
        constants_.fill(0.0f);
        constantsWriter_ = writer;
        return false;
    }
    /// True when the memory of the group is enough for `capacity` elements with the columns `present` of
    /// `kind`.
    bool fits(const KindDesc& kind, size_t capacity, ColumnSet present) const;
    size_t bytes() const { return storage_.capacity() * sizeof(float) + ids_.capacity() * sizeof(uint64_t); }
    /// Makes room for `capacity` elements of `kind`. Memory is allocated only if the present memory is too
    /// small.
    void prepare(const SnapshotSchema& schema, KindId kind, size_t capacity, ColumnSet present = kAllColumns);
    /// Does the same as prepare() and returns true, if the last call had the same arguments and the memory
    /// has exactly the required size. Returns false and does nothing in all other cases.
    /// @param forgets true: constants become zero; false: constants do not change
    bool prepareAgain(KindId kind, size_t capacity, ColumnSet present, bool forgets)
    {
        if (!isExact_ || info_.kind != kind || capacity_ != capacity || present_ != present)
            return false;
        info_ = GroupInfo{};
        info_.kind = kind;
        if (forgets)
            forgetConstants();
        return true;
    }

private:
    void forgetConstants()
    {
        constants_.fill(0.0f);
        constantsWriter_ = 0;
    }

    /// Pointer to the first element of a column.
    const float* place(size_t index) const { return storage_.data() + size_t(lines_[index]) * kRowsPerLine; }
    static constexpr size_t kRowsPerLine = 16; ///< floats in 64 bytes

    // The members that each publication uses come first, in common cache lines.
    GroupInfo info_;
    size_t capacity_ = 0;
    ColumnSet present_ = 0;
    Column<float> storage_;
    uint64_t constantsWriter_ = 0;
    uint32_t constantCount_ = 0;
    bool hasIds_ = true;
    bool isExact_ = false; ///< true: the memory has exactly the required size
    std::array<float, kMaxConstants> constants_{};
    std::array<uint32_t, kMaxColumns> lines_{}; ///< number of lines of 64 bytes before each column
    std::pmr::memory_resource* memory_;
    std::pmr::vector<uint64_t> ids_;
    std::shared_ptr<const GpuParticleProgram> program_;
};

} // namespace fx::base
