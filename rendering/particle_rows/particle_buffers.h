/// @file particle_buffers.h
/// Rows of snapshots on the GPU. Each snapshot is written once, column by column, to persistently mapped
/// memory. A snapshot is first the newer snapshot of frames, later the older snapshot.
///
/// When a buffer is reused, unchanged ranges of rows are not written again. So constant rows are written
/// only three times, once per buffer. Groups with equal rows share one copy of the rows.
///
/// A group is written when a frame first draws the group. Pooled groups are written only if a pooled group
/// is drawn without merging.
///
/// Rows of particles are packed to 24 bytes, or more with optional columns, see packed_rows.h. Rows of
/// ribbons have 32 bytes. Three buffers are used in rotation: frames read two buffers while the third buffer
/// is written.
///
/// Usually a frame writes one snapshot. If the frame rate is below the snapshot rate, neither snapshot of a
/// frame may be present on the GPU. Then the frame writes only the interpolated rows. If a second frame
/// shows these two snapshots, both snapshots are written.
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

/// Revisions that identify rows on the GPU.
struct UploadRevisions
{
    RevisionPair snapshots; ///< revisions of the snapshots; snapshots with equal revisions share a buffer
    SnapshotRowRevisions newerRows, olderRows;
};

class ParticleBuffers
{
public:
    /// @param techniques techniques whose groups are written; the techniques must stay valid
    ParticleBuffers(GlDevice& device, std::span<const RowTechnique* const> techniques,
                    std::pmr::memory_resource* memory);

    /// Writes missing rows, and sets buffers, textures and meshes of the frame's batches.
    /// @return OutOfMemory, GlFailed, TooLarge (a group exceeds the limit of storage buffers)
    base::Status prepare(const base::SnapshotPair& snapshots, const UploadRevisions& revisions,
                         ParticleFrame& frame, const base::AssetTable* assets);
    /// Must be called instead of prepare() if the frame draws the rows of the last frame.
    void keep(const ParticleFrame& frame);
    /// Must be called instead of prepare() for a frame without particles. After many frames without
    /// particles, all buffers are deleted until the next prepare().
    void idle();
    /// Inserts fences, so that a buffer is not overwritten while the GPU reads it. Must be called after all
    /// draws of the frame have been issued.
    void fence();
    /// Requests to compute rows on the GPU before the frame's batches are drawn.
    std::span<const GpuRowsJob> jobs() const { return jobs_; }
    /// True if computing particles on the GPU has failed in this context.
    bool refusesGpu() const { return refusesGpu_; }
    void warmUp(const base::GpuParticleProgram& emitter);
    /// Must be called if the last frame failed. Marks the rows of the last frame's jobs as invalid.
    void forgetComputed();

    /// [byte] size of the rows that the last prepare() uploaded.
    uint64_t uploadedBytes() const { return uploadedBytes_; }
    /// [byte] size of the rows that the last prepare() reused from an earlier snapshot.
    uint64_t keptBytes() const { return keptBytes_; }
    /// [byte] size of the rows that the last prepare() did not upload, because an earlier group of the
    /// snapshot has equal rows.
    uint64_t sharedBytes() const { return sharedBytes_; }
    uint64_t bytes() const; ///< [byte] size of all buffers

private:
    /// Location of the rows of a group in the buffers of a Place.
    struct GroupPlace
    {
        uint64_t offset = 0, bytes = 0;
        /// Offsets of the columns in words, relative to `offset`; -1: the column does not exist.
        RowPlaces columns{};
        // The following members are used only for rows that the GPU computes. For such rows, `offset`,
        // `bytes` and `columns` refer to the buffer Place::computed.
        uint64_t wordsOffset = 0, wordsBytes = 0; ///< range of the input data of the computation
        bool isComputed = false;
        bool isThere = false;  ///< true: the rows are valid after the jobs of this frame have run
        bool isPacked = false; ///< true: the rows have the layout of packed_rows.h
        /// True: the CPU has written the rows. Groups that are not drawn are not written.
        bool isWritten = false;
        bool isShared = false;             ///< true: the group shares the rows of an earlier group
        size_t rowsBegin = 0, rowsEnd = 0; ///< range of the group's revisions in Place::rows
    };
    struct Place
    {
        GlMappedBuffer buffer;
        GlBuffer computed;     ///< rows that the GPU writes
        uint64_t revision = 0; ///< revision of the content; 0: no content
        uint64_t usedFrame = 0;
        bool hasPools = false; ///< true: the buffers include pooled groups
        std::pmr::vector<GroupPlace> groups;
        std::pmr::vector<RowRevision> rows;        ///< revisions of all groups
        std::pmr::vector<GroupPlace> groupsBefore; ///< locations of the groups in the previous snapshot
        std::pmr::vector<RowRevision> rowsBefore;

        explicit Place(std::pmr::memory_resource* memory)
            : groups(memory), rows(memory), groupsBefore(memory), rowsBefore(memory)
        {}
    };
    /// Total sizes of groups in the two buffers of a Place.
    struct Sizes
    {
        uint64_t mapped = 0, computed = 0; ///< [byte]
    };

    /// A snapshot whose rows are written.
    struct Source
    {
        const base::FrameSnapshot* snapshot;
        uint64_t revision; ///< revision of the snapshot; 0: rows are interpolated
        SnapshotRowRevisions rows;
        bool withPools; ///< true: also write pooled groups
        bool isOlder;   ///< true: the snapshot is the older snapshot of the frame
        // The following members are used only for interpolated rows.
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
    /// True if the rows of a group equal the rows of an earlier group.
    bool isAlike(const Source& source, size_t group) const;
    base::Status makeRoom(const Sizes& sizes, Place& place);
    Sizes layOut(const Source& source, std::pmr::vector<GroupPlace>& out) const;
    void layOutRows(const base::SnapshotGroup& group, const RowTechnique& technique, GroupPlace& out) const;
    base::Status ensureComputed(GlBuffer& buffer, uint64_t bytes);
    /// Sets the buffer range of the rows of a batch. If the GPU must compute the rows, a job is added.
    base::Status takeRows(Place& place, const base::SnapshotGroup& group, size_t index, uint32_t batch,
                          bool isNewer, BufferPart& outPart);
    void write(const Source& source, Place& place);
    /// Writes the rows of a group.
    /// @param before location of the group's previous rows, with equal columns; null: the location is
    ///     unknown
    void writeRows(const Source& source, size_t group, const GroupPlace* before, Place& place);
    /// Writes a range of the rows of a group.
    /// @param stands true: the rows equal the present content of the buffer
    void writePart(const Source& source, size_t group, const RowRevision& part, bool stands, Place& place);
    base::Status writeOrders(ParticleFrame& frame);
    base::Status findAssets(ParticleFrame& frame, const base::AssetTable* assets);

    GlDevice& device_;
    std::span<const RowTechnique* const> techniques_;
    std::array<Place, 3> places_;
    std::array<GlMappedBuffer, 3> orders_;

    /// Buffers of places_ and orders_ that the draws of the current frame read: older rows, newer rows and
    /// orders. Null: the frame does not read the buffer.
    std::array<GlMappedBuffer*, 3> drawn_{};

    GlAssetCache assets_;
    GpuEmitters emitters_;
    GpuStates states_;
    std::pmr::vector<GpuRowsJob> jobs_;
    std::pmr::vector<uint8_t> wanted_; ///< for each group of the written snapshot: 1 if the group is drawn
    /// For each group of the newer snapshot: index of the older group. Used only for interpolated rows.
    std::pmr::vector<size_t> older_;
    RevisionPair mixed_; ///< revisions of the snapshots between which the last frame was interpolated
    bool refusesGpu_ = false;
    uint64_t frame_ = 0;
    uint32_t idleFrames_ = 0; ///< number of successive calls of idle()
    uint64_t uploadedBytes_ = 0;
    uint64_t keptBytes_ = 0;
    uint64_t sharedBytes_ = 0;
};

} // namespace fx::render
