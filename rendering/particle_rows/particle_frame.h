/// @file particle_frame.h
/// Selects the visible groups of particles and ribbons of two snapshots, sorts their rows, and computes the
/// uniforms of their shaders. Makes no GL calls, and copies no rows.
#pragma once

#include "foundation/snapshot/snapshot_ring.h"
#include "rendering/draw_order/depth_sort.h"
#include "rendering/draw_order/draw_batcher.h"
#include "rendering/frame/fragment_counts.h"
#include "rendering/frame/view_types.h"
#include "rendering/gpu_particles/gpu_order_pass.h"
#include "rendering/lod/level_of_detail.h"
#include "rendering/particle_rows/group_merger.h"
#include "rendering/particle_rows/row_technique.h"
#include "rendering/passes/particle_batch.h"

#include <memory>
#include <memory_resource>
#include <span>
#include <vector>

namespace fx::render {

/// Format of the list of drawn rows; shaders use equal values.
enum class OrderForm : uint8_t
{
    All,            ///< no list: all rows are drawn, in the order of rows
    Rows,           ///< one word for each drawn row: the index of the row
    FactorsBeside,  ///< two words for each drawn row: index, and factors of size and opacity
    RowFactorsOnly, ///< one word for each row, in the order of rows: the factors of size and opacity
};

/// A drawn group. Group and batch have the same index.
struct ParticleGroup
{
    const RowTechnique* technique;
    const base::SnapshotGroup* newer;
    const base::SnapshotGroup* older; ///< null for strips, and if there is no older group
    size_t newerIndex, olderIndex;    ///< indices of the group in the two snapshots
    /// Indices of rows in the order of drawing; empty: all rows are drawn, in the order of rows.
    std::span<const uint32_t> order;
    /// For each row: factors of size and opacity, see simplifyRows(). Empty: all rows are drawn unchanged.
    std::span<const uint32_t> factors;
    uint32_t texture, motion, mesh; ///< ids in the asset table
    int columns, rows;              ///< number of frames of the texture along x and y
    OrderForm orderForm = OrderForm::All;
};

/// Inputs of the particles of a frame.
struct ParticleFrameInputs
{
    const base::SnapshotPair* snapshots;
    const FrameRequest* request;
    const ViewSettings* settings;
    const CameraGeometry* camera;
    std::span<const uint8_t> left = {}; ///< for each group of the newer snapshot: 1 if the group is omitted
    /// Level of detail. LevelOfDetail::begin() must have been called. Null: all rows are drawn.
    LevelOfDetail* lod = nullptr;
    /// Merger that has created the snapshots. Null: the snapshots have no merged groups.
    const GroupMerger* merger = nullptr;
    std::span<const RowTechnique* const> techniques = {};
};

/// Numbers of drawn elements. For groups that the GPU computes, the capacity is counted.
struct DrawnCounts
{
    uint64_t sprites = 0;
    uint64_t meshes = 0;
    uint64_t ribbonPieces = 0; ///< number of pieces of strips; each piece lies between two points
};

/// Owns the sorted lists of rows of one view. Lists and memory are kept from frame to frame.
class ParticleFrame
{
public:
    explicit ParticleFrame(std::pmr::memory_resource* memory);
    ~ParticleFrame();

    void build(const ParticleFrameInputs& in);

    /// Removes the groups that are computed on the GPU.
    void dropComputed();

    std::span<const ParticleGroup> groups() const { return groups_; }
    std::span<ParticleBatch> batches() { return batches_; }
    /// Requests to sort the rows of batches that the GPU computes.
    std::span<const GpuOrderJob> gpuOrders() const { return gpuOrders_; }
    /// Streams of the batches that are not opaque, for DrawBatcher.
    std::span<const DrawStream> streams() const { return streams_; }
    const DrawnCounts& drawn() const { return drawn_; }
    /// True if outputs contain motion. In this mode, the rows of both snapshots are required, and groups are
    /// not merged.
    bool keepsSnapshots() const { return keepsSnapshots_; }
    uint64_t orderedRows() const { return orderedRows_; } ///< number of sorted rows
    /// Number of rows that the level of detail omitted.
    uint64_t thinnedRows() const { return thinnedRows_; }
    /// Estimated number of fragments of transparent rows.
    const FragmentCounts& fragments() const { return fragments_; }

private:
    struct Orderer;

    void addGroup(const ParticleFrameInputs& in, size_t index, const RowTechnique& technique);
    void fillBlock(const ParticleFrameInputs& in, const base::Placement& place, ParticleGroup& group,
                   ParticleBatch& batch);
    void arrangeRows(const ParticleFrameInputs& in, const base::Placement& place, ParticleGroup& group,
                     ParticleBatch& batch, DrawStream& stream, uint32_t& shownRows);
    static OrderForm formOf(const ParticleGroup& group, base::ParticleOrder mode, uint32_t rows);
    bool thin(const ParticleFrameInputs& in, const base::Placement& place, const ParticleGroup& group,
              const ParticleBatch& batch, Orderer& orderer);
    static void sortRows(const ParticleFrameInputs& in, const base::Placement& place, ParticleGroup& group,
                         base::ParticleOrder mode, bool isThinned, Orderer& orderer);
    void countRows(const ParticleGroup& group, const ParticleBatch& batch, uint64_t thinned);
    void orderOnGpu(const ParticleFrameInputs& in, const base::Placement& place, const ParticleGroup& group,
                    ParticleBatch& batch);
    Orderer& ordererOf(const base::GroupInfo& info);

    std::pmr::memory_resource* memory_;
    std::pmr::vector<ParticleGroup> groups_;
    std::pmr::vector<ParticleBatch> batches_;
    std::pmr::vector<DrawStream> streams_;
    std::pmr::vector<GpuOrderJob> gpuOrders_;
    std::pmr::vector<std::unique_ptr<Orderer>> orderers_;
    size_t lastOrderer_ = 0; ///< index in orderers_ of the last result of ordererOf()
    uint64_t frame_ = 0;
    bool keepsSnapshots_ = false;
    DrawnCounts drawn_;
    uint64_t orderedRows_ = 0;
    uint64_t thinnedRows_ = 0;
    FragmentCounts fragments_{};
};

} // namespace fx::render
