/// @file particle_buffers.h
/// Rows of snapshots on the GPU: each snapshot is written once, column by column, into memory that stays
/// mapped, and serves as the newer and then as the older of two.
///
/// A place that is written again keeps the rows that lie there already, part by part: what stands still is
/// written three times and then no more, whatever moves beside it. Groups with the same rows share them.
///
/// Groups that a frame does not draw are not written; should another frame draw them, they are then.
/// Groups whose rows are in pools are written only where one of them is drawn by itself.
///
/// Rows of particles are packed, see packed_rows.h: 24 bytes, and 4 with a velocity; those of ribbons
/// take 32. Three places take turns: the two that frames read, and the one being written.
///
/// A frame writes one snapshot at most. Where neither of its two is there, as when frames are fewer than
/// snapshots, one state is written: that of the frame's moment, mixed of both. Only when a second frame shows
/// the same two are both written, for those that may follow.
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

/// What tells whether rows are there already.
struct UploadRevisions
{
    RevisionPair snapshots; ///< equal ones share a place
    SnapshotRowRevisions newerRows, olderRows;
};

class ParticleBuffers
{
public:
    /// @param techniques whose groups are written; must stay
    ParticleBuffers(GlDevice& device, std::span<const RowTechnique* const> techniques,
                    std::pmr::memory_resource* memory);

    /// Writes what is not yet there and fills in the batches' buffers, textures and meshes.
    /// @return OutOfMemory, GlFailed, TooLarge (a group is larger than the context's storage buffers)
    base::Status prepare(const base::SnapshotPair& snapshots, const UploadRevisions& revisions,
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
        RowPlaces columns{}; ///< in words from the offset; -1: not there
        // Only of rows that are computed: those members are about the buffer `computed`.
        uint64_t wordsOffset = 0, wordsBytes = 0; ///< of what they are computed from
        bool isComputed = false;
        bool isThere = false;              ///< or will be, when the jobs of this frame have run
        bool isPacked = false;             ///< as packed_rows.h says
        bool isWritten = false;            ///< what the CPU has of it; a group that is not drawn is not
        bool isShared = false;             ///< it is the place of a group before it
        size_t rowsBegin = 0, rowsEnd = 0; ///< of Place::rows: what is there
    };
    struct Place
    {
        GlMappedBuffer buffer;
        GlBuffer computed;     ///< rows that the GPU writes
        uint64_t revision = 0; ///< of what is there; 0: nothing
        uint64_t usedFrame = 0;
        bool hasPools = false; ///< groups of pools are there, too
        std::pmr::vector<GroupPlace> groups;
        std::pmr::vector<RowRevision> rows;        ///< of all groups
        std::pmr::vector<GroupPlace> groupsBefore; ///< what lay there until now
        std::pmr::vector<RowRevision> rowsBefore;

        explicit Place(std::pmr::memory_resource* memory)
            : groups(memory), rows(memory), groupsBefore(memory), rowsBefore(memory)
        {}
    };
    /// What groups need of the two buffers of a place.
    struct Sizes
    {
        uint64_t mapped = 0, computed = 0; ///< [byte]
    };

    /// What is written into a place.
    struct Source
    {
        const base::FrameSnapshot* snapshot;
        uint64_t revision; ///< 0: mixed
        SnapshotRowRevisions rows;
        bool withPools; ///< also groups whose rows are in pools
        bool isOlder;   ///< of the two of the frame
        // Only of what is mixed:
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
    /// The rows of a batch; those that are not there become a job.
    base::Status takeRows(Place& place, const base::SnapshotGroup& group, size_t index, uint32_t batch,
                          bool isNewer, BufferPart& outPart);
    void write(const Source& source, Place& place);
    /// @param before what lay there until now, in the same columns; null: something else
    void writeRows(const Source& source, size_t group, const GroupPlace* before, Place& place);
    /// @param stands they are the same in the snapshot before
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
    std::pmr::vector<size_t> older_;   ///< by group of the newer snapshot; only of what is mixed
    RevisionPair mixed_;               ///< snapshots of which the last frame was mixed
    bool refusesGpu_ = false;
    uint64_t frame_ = 0;
    uint32_t idleFrames_ = 0; ///< one after the other
    uint64_t uploadedBytes_ = 0;
    uint64_t keptBytes_ = 0;
    uint64_t sharedBytes_ = 0;
};

} // namespace fx::render
