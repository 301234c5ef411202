/// @file particle_buffers.h
/// Rows of snapshots on the GPU. Each snapshot is written once, column by column, into persistently mapped
/// memory, and is used first as the newer and then as the older of two.
///
/// A buffer that is reused keeps unchanged rows, part by part, so rows at rest are written only three times.
/// Groups with the same rows share them.
///
/// Groups are written when a frame draws them first. Groups with rows in pools are written only if one of
/// them is drawn separately.
///
/// Rows of particles are packed, see packed_rows.h: 24 bytes, and 4 with a velocity; those of ribbons take
/// 32. Three buffers are used in rotation: the two that frames read, and the one being written.
///
/// A frame writes at most one snapshot. If neither of its two snapshots is present, as when the frame rate is
/// below the snapshot rate, only the interpolated state of the frame is written. When a second frame shows
/// the same two snapshots, both are written for further frames.
///
/// Threads: [GL thread].
#pragma once

#include "foundation/assets/asset_table.h"
#include "foundation/snapshot/snapshot_ring.h"
#include "rendering/frame/snapshot_revisions.h"
#include "rendering/gl/gl_asset_cache.h"
#include "rendering/gl/gl_mapped_buffer.h"
#include "rendering/gpu_particles/gpu_emitters.h"
#include "rendering/gpu_particles/gpu_rows_pass.h"
#include "rendering/gpu_particles/gpu_states.h"
#include "rendering/particle_rows/packed_rows.h"
#include "rendering/particle_rows/particle_frame.h"

#include <array>
#include <cstdint>
#include <memory_resource>
#include <vector>

namespace fx::render {

/// Revisions by which present rows are recognized.
struct UploadRevisions
/// equal ones share a place
{
    RevisionPair snapshots;
    SnapshotRowRevisions newerRows, olderRows;
};

class ParticleBuffers
{
public:
    /// @param techniques whose groups are written; must stay
    ParticleBuffers(GlDevice& device, std::span<const RowTechnique* const> techniques,
                    std::pmr::memory_resource* memory);

    /// Writes missing rows and fills in the batches' buffers, textures and meshes.
    /// @return OutOfMemory, GlFailed, TooLarge (a group is larger than the context's storage buffers)
    base::Status prepare(const base::SnapshotPair& snapshots, const UploadRevisions& revisions,
                         ParticleFrame& frame, const base::AssetTable* assets);
    /// Called instead of prepare(): the frame draws the rows of the last frame.
    void keep(const ParticleFrame& frame);
    /// A frame without particles; after many in a row everything is deleted, until the next prepare().
    void idle();
    /// To be called when all draws of the frame have been issued.
    void fence();
    /// Rows to compute on the GPU before the frame's batches are drawn.
    std::span<const GpuRowsJob> jobs() const { return jobs_; }
    /// True once the context has refused to compute particles.
    bool refusesGpu() const { return refusesGpu_; }
    void warmUp(const base::GpuParticleProgram& emitter);
    /// Invalidates the rows that the last frame, which failed, should have computed.
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
        RowPlaces columns{}; ///< in words from the offset; -1: absent
        // Only of rows that are computed: those members are about the buffer `computed`.
        uint64_t wordsOffset = 0, wordsBytes = 0; ///< range of the input data
        bool isComputed = false;
        bool isThere = false;  ///< valid after the jobs of this frame have run
        bool isPacked = false; ///< in the layout of packed_rows.h
        /// Rows of the CPU are written; false for groups that are not drawn.
        bool isWritten = false;
        bool isShared = false;             ///< shares the rows of an earlier group
        size_t rowsBegin = 0, rowsEnd = 0; ///< valid range of Place::rows
    };
    struct Place
    {
        GlMappedBuffer buffer;
        GlBuffer computed;     ///< rows that the GPU writes
        uint64_t revision = 0; ///< revision of the content; 0: none
        uint64_t usedFrame = 0;
        bool hasPools = false; ///< includes groups of pools
        std::pmr::vector<GroupPlace> groups;
        std::pmr::vector<RowRevision> rows;        ///< of all groups
        std::pmr::vector<GroupPlace> groupsBefore; ///< previous content
        std::pmr::vector<RowRevision> rowsBefore;

        explicit Place(std::pmr::memory_resource* memory)
            : groups(memory), rows(memory), groupsBefore(memory), rowsBefore(memory)
        {}
    };
    /// Sizes of groups in the two buffers of a place.
    struct Sizes
    /// [byte]
    {
        uint64_t mapped = 0, computed = 0;
    };

    /// Input of a write.
    struct Source
    {
        const base::FrameSnapshot* snapshot;
        uint64_t revision; ///< 0: mixed
        SnapshotRowRevisions rows;
        bool withPools; ///< also groups whose rows are in pools
        bool isOlder;   ///< of the two of the frame
        // Only for interpolated rows:
        const base::FrameSnapshot* older = nullptr;
        SnapshotRowRevisions olderRows = {};
        RowMoment moment = {};
    };
    Place* find(uint64_t revision, bool withPools);
    base::Status makeResident(const Source& source, const ParticleFrame& frame, Place*& out);
    void listWanted(const Source& source, const ParticleFrame& frame);
    base::Status makeTwoResident(const base::SnapshotPair& snapshots, const UploadRevisions& revisions,
                                 ParticleFrame& frame, Place*& older, Place*& newer);
    bool mixes(const base::SnapshotPair& snapshots, const UploadRevisions& revisions, ParticleFrame& frame);
    size_t olderOf(size_t group) const;
    /// Whether the rows of a group are those of one before it.
    bool isAlike(const Source& source, size_t group) const;
    base::Status makeRoom(const Sizes& sizes, Place& place);
    Sizes layOut(const Source& source, std::pmr::vector<GroupPlace>& out) const;
    void layOutRows(const base::SnapshotGroup& group, const RowTechnique& technique, GroupPlace& out) const;
    base::Status ensureComputed(GlBuffer& buffer, uint64_t bytes);
    /// Rows of a batch; missing ones of the GPU become a job.
    base::Status takeRows(Place& place, const base::SnapshotGroup& group, size_t index, uint32_t batch,
                          bool isNewer, BufferPart& outPart);
    void write(const Source& source, Place& place);
    /// @param before previous content with the same columns; null: other content
    void writeRows(const Source& source, size_t group, const GroupPlace* before, Place& place);
    /// @param stands the rows are equal in the previous snapshot
    void writePart(const Source& source, size_t group, const RowRevision& part, bool stands, Place& place);
    base::Status writeOrders(ParticleFrame& frame);
    base::Status findAssets(ParticleFrame& frame, const base::AssetTable* assets);

    GlDevice& device_;
    std::span<const RowTechnique* const> techniques_;
    std::array<Place, 3> places_;
    std::array<GlMappedBuffer, 3> orders_;

    /// Buffers of places_ and orders_ from which the draws of the current frame read: the older rows, the
    /// newer rows and the orders. Null where the frame reads none.
    std::array<GlMappedBuffer*, 3> drawn_{};

    GlAssetCache assets_;
    GpuEmitters emitters_;
    GpuStates states_;
    std::pmr::vector<GpuRowsJob> jobs_;
    std::pmr::vector<uint8_t> wanted_; ///< by group of the snapshot that is written now: it is drawn
    std::pmr::vector<size_t> older_;   ///< by group of the newer snapshot; only for interpolated rows
    RevisionPair mixed_;               ///< snapshots of which the last frame was mixed
    bool refusesGpu_ = false;
    uint64_t frame_ = 0;
    uint32_t idleFrames_ = 0; ///< one after the other
    uint64_t uploadedBytes_ = 0;
    uint64_t keptBytes_ = 0;
    uint64_t sharedBytes_ = 0;
};

} // namespace fx::render
