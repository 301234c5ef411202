/// @file frame_snapshot.h
/// The state of a scene after one step, as rendering and hosts see it: the only place where both sides meet.
///
/// A snapshot is a list of groups in creation order. A group holds the elements of one kind that one solver
/// of one instance published: typed columns, shared constants, bounds, and an id per element by which the
/// same element is found in the snapshot before. Threads: written by one thread, then published through a
/// SnapshotRing and never changed again; read by any.
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

/// What a group is, apart from its columns.
struct GroupInfo
{
    KindId kind = 0;
    uint64_t instance = 0;   ///< identity of the instance within the scene
    uint32_t solver = 0;     ///< position of the solver in its effect
    uint32_t count = 0;      ///< elements
    Placement placement;     ///< columns are relative to this
    Bounds bounds;           ///< local; every element with its radius lies inside
    bool isCosmetic = false; ///< outside of the snapshot's hash: may be computed on the GPU
};

class GpuParticleProgram;

/// One group: column-wise elements, sorted by ascending id where the kind has ids. Columns begin at multiples
/// of 64 bytes; those that the group has follow each other in the order of the kind, each with room for
/// capacity() elements rounded up to 64 bytes.
class SnapshotGroup
{
public:
    SnapshotGroup(std::pmr::memory_resource* memory) : memory_(memory), ids_(memory) {}

    const GroupInfo& info() const { return info_; }
    uint32_t count() const { return info_.count; }
    /// Empty when the kind has none.
    std::span<const uint64_t> ids() const { return {ids_.data(), hasIds_ ? info_.count : 0}; }
    /// Column `index` of the kind, which is F32; empty when the group lacks it.
    std::span<const float> column(size_t index) const { return {place(index), has(index) ? info_.count : 0}; }
    /// Column `index` of the kind, which is U64; empty when the group lacks it.
    std::span<const uint64_t> column64(size_t index) const
    {
        return {reinterpret_cast<const uint64_t*>(place(index)), has(index) ? info_.count : 0};
    }
    bool has(size_t index) const { return (present_ >> index & 1) != 0; }
    std::span<const float> constants() const { return {constants_.data(), constantCount_}; }
    /// Of the kind "gpuParticle", see gpu_particles.h; null elsewhere.
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
    /// Room for all columns that it has.
    float* editStorage() { return storage_.data(); }
    size_t capacity() const { return capacity_; }
    /// True when its constants are what the writer with the number `writer` has written into its memory
    /// before and nobody has changed since: then they need not be written again. If not, they are zero, and
    /// taken to be written now.
    /// @param writer not 0; names what is written, for the life of the process
    bool keepsConstants(uint64_t writer)
    {
        if (constantsWriter_ == writer)
            return true;
        constants_.fill(0.0f);
        constantsWriter_ = writer;
        return false;
    }
    /// True when its memory is enough for `capacity` elements with the columns `present` of `kind`.
    bool fits(const KindDesc& kind, size_t capacity, ColumnSet present) const;
    size_t bytes() const { return storage_.capacity() * sizeof(float) + ids_.capacity() * sizeof(uint64_t); }
    /// Makes room for `capacity` elements of `kind`; keeps its memory when that is enough.
    void prepare(const SnapshotSchema& schema, KindId kind, size_t capacity, ColumnSet present = kAllColumns);
    /// The same where it was prepared for the same the last time and its memory is exactly that; otherwise
    /// false. Constants are left as they are for keepsConstants(), or are zero when `forgets`.
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

    /// Where a column begins.
    const float* place(size_t index) const { return storage_.data() + size_t(lines_[index]) * kRowsPerLine; }
    static constexpr size_t kRowsPerLine = 16; ///< floats in 64 bytes

    // What is read and written for each publication stands together in front.
    GroupInfo info_;
    size_t capacity_ = 0;
    ColumnSet present_ = 0;
    Column<float> storage_;
    uint64_t constantsWriter_ = 0;
    uint32_t constantCount_ = 0;
    bool hasIds_ = true;
    bool isExact_ = false; ///< its memory is not larger than it needs
    std::array<float, kMostConstants> constants_{};
    std::array<uint32_t, kMostColumns> lines_{}; ///< of 64 bytes before each column
    std::pmr::memory_resource* memory_;
    std::pmr::vector<uint64_t> ids_;
    std::shared_ptr<const GpuParticleProgram> program_;
};

/// All groups after the step that ended at `tick`.
class FrameSnapshot
{
public:
    FrameSnapshot(const SnapshotSchema* schema, std::pmr::memory_resource* memory);

    const SnapshotSchema& schema() const { return *schema_; }
    std::pmr::memory_resource* memory() const { return memory_; }
    Ticks tick() const { return tick_; }
    uint64_t sequence() const { return sequence_; } ///< 1 for the first published, then rising by 1; 0: never
    /// [s] since the snapshot before; what was born within them is drawn on its way. 0: there is none.
    float secondsBack() const { return secondsBack_; }
    size_t groupCount() const { return groupCount_; }
    const SnapshotGroup& group(size_t index) const { return groups_[index]; }

    /// Hash of every id, column, constant and placement, computed anew at each call.
    uint64_t hash() const;

    // ---- for the writer, before publication ----
    void begin(Ticks tick, uint64_t sequence);
    /// To be called after begin().
    void follows(const FrameSnapshot& before) { secondsBack_ = float(toSeconds(tick_ - before.tick_)); }
    /// A group with room for `capacity` elements; fill it and set its info (count, bounds). The memory of a
    /// group of an earlier snapshot is reused when one is large enough, whatever its position was.
    /// @param present columns of the kind that the group is to have
    SnapshotGroup& addGroup(KindId kind, size_t capacity, ColumnSet present = kAllColumns)
    {
        if (groupCount_ < groups_.size() && groups_[groupCount_].prepareAgain(kind, capacity, present, true))
            return groups_[groupCount_++]; // as in the snapshot before: there is none that fits better
        return findGroup(kind, capacity, present);
    }
    /// The same for a writer that heeds SnapshotGroup::keepsConstants().
    SnapshotGroup& addGroupAgain(KindId kind, size_t capacity, ColumnSet present)
    {
        if (groupCount_ + 2 < groups_.size())
            __builtin_prefetch(&groups_[groupCount_ + 2], 1);
        if (groupCount_ < groups_.size() && groups_[groupCount_].prepareAgain(kind, capacity, present, false))
            return groups_[groupCount_++];
        return findGroup(kind, capacity, present);
    }
    SnapshotGroup& editGroup(size_t index) { return groups_[index]; }

private:
    SnapshotGroup& findGroup(KindId kind, size_t capacity, ColumnSet present);

    const SnapshotSchema* schema_;
    std::pmr::memory_resource* memory_;
    Ticks tick_ = 0;
    uint64_t sequence_ = 0;
    float secondsBack_ = 0;
    size_t groupCount_ = 0;
    std::pmr::vector<SnapshotGroup>
        groups_; ///< the first groupCount_ are valid, the rest keep memory for later
};

} // namespace fx::base
