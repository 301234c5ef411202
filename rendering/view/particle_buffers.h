/// @file particle_buffers.h
/// Rows of snapshots on the GPU: each snapshot is written once, column by column, into memory that stays
/// mapped, and serves as the newer and then as the older of two.
///
/// A place that is written again keeps the rows that lie there already, part by part: what stands still is
/// written three times and then no more, whatever moves beside it. Groups with the same rows share them.
///
/// Groups whose rows are in pools are written only where one of them is drawn by itself.
///
/// 28 bytes a row: position, age, radius, color; more only for columns that a group has. Three places take
/// turns: the two that frames read, and the one being written. Threads: [GL thread].
#pragma once

#include "foundation/assets/asset_table.h"
#include "foundation/snapshot/snapshot_ring.h"
#include "rendering/gl/gl_asset_cache.h"
#include "rendering/gl/gl_mapped_buffer.h"
#include "rendering/gpu_particles/gpu_emitters.h"
#include "rendering/gpu_particles/gpu_rows_pass.h"
#include "rendering/gpu_particles/gpu_states.h"
#include "rendering/view/particle_frame.h"
#include "rendering/view/snapshot_stamps.h"

#include <array>
#include <cstdint>
#include <memory_resource>
#include <vector>

namespace fx::render {

/// What tells whether rows are there already.
struct UploadStamps
{
    StampPair snapshots; ///< equal ones share a place
    SnapshotRowStamps newerRows, olderRows;
};

class ParticleBuffers
{
public:
    ParticleBuffers(GlDevice& device, std::pmr::memory_resource* memory);

    /// Writes what is not yet there and fills in the batches' buffers, textures and meshes.
    /// @return OutOfMemory, GlFailed, TooLarge (a group is larger than the context's storage buffers)
    base::Status prepare(const base::SnapshotPair& snapshots, const UploadStamps& stamps,
                         ParticleFrame& frame, const base::AssetTable* assets);
    /// Instead of prepare(): the frame draws what the last one has drawn.
    void keep(const ParticleFrame& frame);
    /// A frame without particles; after many in a row everything is deleted, until the next prepare().
    void idle();
    /// To be called when all draws of the frame have been issued.
    void fence();
    /// What has to be computed before the frame's batches are drawn.
    std::span<const GpuRowsJob> jobs() const { return jobs_; }
    /// True once the context has refused to compute particles.
    bool refusesGpu() const { return refusesGpu_; }
    void warmUp(const base::GpuParticleProgram& emitter);
    /// The last frame has failed: what it was to compute is not there.
    void forgetComputed();

    uint64_t uploadedBytes() const { return uploadedBytes_; } ///< [byte] of the last prepare()
    /// [byte] of the last prepare(): rows that were where they belong since an earlier snapshot.
    uint64_t keptBytes() const { return keptBytes_; }
    /// [byte] of the last prepare(): rows that are the same as those of a group before.
    uint64_t sharedBytes() const { return sharedBytes_; }
    uint64_t bytes() const; ///< [byte] held

private:
    /// Where a group of a snapshot lies.
    struct GroupPlace
    {
        uint64_t offset = 0, bytes = 0;
        std::array<int32_t, 16> columns{}; ///< in words from the offset; -1: not there
        // Only of rows that are computed: those members are about the buffer `computed`.
        uint64_t wordsOffset = 0, wordsBytes = 0; ///< of what they are computed from
        bool isComputed = false;
        bool isThere = false;              ///< or will be, when the jobs of this frame have run
        bool isShared = false;             ///< it is the place of a group before it
        size_t rowsBegin = 0, rowsEnd = 0; ///< of Place::rows: what is there
    };
    struct Place
    {
        GlMappedBuffer buffer;
        GlBuffer computed;  ///< rows that the GPU writes
        uint64_t stamp = 0; ///< of what is there; 0: nothing
        uint64_t usedFrame = 0;
        bool hasPools = false; ///< groups of pools are there, too
        std::pmr::vector<GroupPlace> groups;
        std::pmr::vector<RowStamp> rows;           ///< of all groups
        std::pmr::vector<GroupPlace> groupsBefore; ///< what lay there until now
        std::pmr::vector<RowStamp> rowsBefore;

        explicit Place(std::pmr::memory_resource* memory)
            : groups(memory), rows(memory), groupsBefore(memory), rowsBefore(memory)
        {}
    };
    /// What groups need of the two buffers of a place.
    struct Sizes
    {
        uint64_t mapped = 0, computed = 0; ///< [byte]
    };

    /// @param withPools also groups whose rows are in pools
    base::Status makeResident(const base::FrameSnapshot& snapshot, uint64_t stamp,
                              const SnapshotRowStamps& rows, bool withPools, Place*& out);
    base::Status makeRoom(const Sizes& sizes, Place& place);
    Sizes layOut(const base::FrameSnapshot& snapshot, const SnapshotRowStamps& rows, bool withPools,
                 std::pmr::vector<GroupPlace>& out) const;
    base::Status ensureComputed(GlBuffer& buffer, uint64_t bytes);
    /// The rows of a batch; those that are not there become a job.
    base::Status takeRows(Place& place, const base::SnapshotGroup& group, size_t index, uint32_t batch,
                          bool isNewer, BufferPart& outPart);
    void write(const base::FrameSnapshot& snapshot, const SnapshotRowStamps& rows, Place& place);
    void writeRows(const base::SnapshotGroup& group, std::span<const base::ColumnDesc> columns,
                   std::span<const RowStamp> parts, const GroupPlace* before, GroupPlace& at, Place& place);
    base::Status writeOrders(ParticleFrame& frame);
    base::Status findAssets(ParticleFrame& frame, const base::AssetTable* assets);

    GlDevice& device_;
    std::array<Place, 3> places_;
    std::array<GlMappedBuffer, 3> orders_;
    GlAssetCache assets_;
    GpuEmitters emitters_;
    GpuStates states_;
    std::pmr::vector<GpuRowsJob> jobs_;
    bool refusesGpu_ = false;
    uint64_t frame_ = 0;
    uint32_t idleFrames_ = 0; ///< one after the other
    uint64_t uploadedBytes_ = 0;
    uint64_t keptBytes_ = 0;
    uint64_t sharedBytes_ = 0;
};

} // namespace fx::render
