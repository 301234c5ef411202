/// @file particle_frame.h
/// The groups of particles and ribbons of a pair of snapshots as a frame draws them: which are seen, in which
/// order their rows come, and every number that their shaders need. No GL; rows stay where they are.
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

/// Form in which the drawn rows are listed; values are those of the shaders.
enum class OrderForm : uint8_t
{
    All,            ///< no list: all rows, in their order
    Rows,           ///< a word each
    FactorsBeside,  ///< a row and its factors, two words
    RowFactorsOnly, ///< no rows, but the factors of each
};

/// A group that is drawn, beside the batch of the same index.
struct ParticleGroup
{
    const RowTechnique* technique;
    const base::SnapshotGroup* newer;
    const base::SnapshotGroup* older;  ///< null: none, or of a strip
    size_t newerIndex, olderIndex;     ///< in their snapshots
    std::span<const uint32_t> order;   ///< rows in order of drawing; empty: all, in their order
    std::span<const uint32_t> factors; ///< by row, see simplifyRows(); empty: nothing is thinned out
    uint32_t texture, motion, mesh;    ///< ids in the asset table
    int columns, rows;                 ///< frames of the texture
    OrderForm orderForm = OrderForm::All;
};

/// Inputs of the particles of a frame.
struct ParticleFrameInputs
{
    const base::SnapshotPair* snapshots;
    const FrameRequest* request;
    const ViewSettings* settings;
    const CameraGeometry* camera;
    std::span<const uint8_t> left = {};  ///< by group of the newer snapshot: 1 if it is omitted
    LevelOfDetail* lod = nullptr;        ///< begun for this frame; null: everything is drawn
    const GroupMerger* merger = nullptr; ///< that made the snapshots; null: they are the scene's
    std::span<const RowTechnique* const> techniques = {};
};

/// Numbers of drawn elements; for groups on the GPU their capacity.
struct DrawnCounts
{
    uint64_t sprites = 0;
    uint64_t meshes = 0;
    uint64_t ribbonPieces = 0; ///< between two points of a strip
};

/// Owns the orders of one view; they and all memory are kept from frame to frame.
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
    /// In which order the rows of computed batches are to be drawn.
    std::span<const GpuOrderJob> gpuOrders() const { return gpuOrders_; }
    /// Batches that do not hide, for DrawBatcher.
    std::span<const DrawStream> streams() const { return streams_; }
    const DrawnCounts& drawn() const { return drawn_; }
    /// Rows of both snapshots are required, and groups are not merged, because outputs contain the motion of
    /// each group.
    bool keepsSnapshots() const { return keepsSnapshots_; }
    uint64_t orderedRows() const { return orderedRows_; } ///< in orders
    uint64_t thinnedRows() const { return thinnedRows_; } ///< left to others by the level of detail
    /// Estimated fragments of transparent rows.
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
    size_t lastOrderer_ = 0; ///< that ordererOf() found
    uint64_t frame_ = 0;
    bool keepsSnapshots_ = false;
    DrawnCounts drawn_;
    uint64_t orderedRows_ = 0;
    uint64_t thinnedRows_ = 0;
    FragmentCounts fragments_{};
};

} // namespace fx::render
