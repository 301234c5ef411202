/// @file volume_solver.h
/// A medium that does not move, on sparse voxels. It is the same at all times.
#pragma once

#include "foundation/assets/asset_table.h"
#include "foundation/snapshot/blob_kind.h"
#include "simulation/solver/solver.h"

#include <memory>
#include <string>
#include <vector>

namespace fx::sim {

struct VolumeDef final : SolverDef
{
    std::string name;
    std::shared_ptr<const base::VoxelVolume> voxels;
    base::AssetId asset = 0;                          ///< id of `voxels` in the asset table
    std::vector<base::VolumeCells> cells;             ///< volumeCells() of `voxels`
    glm::vec3 position{0.0f};                         ///< [m] of the file's own origin
    float scale = 1.0f;                               ///< [1] multiplies lengths, > 0
    float density = 1.0f;                             ///< [1] multiplies the extinction, >= 0
    float anisotropy = 0.0f;                          ///< [1] mean cosine of the scattering angle
    float fireShare = 0.0f;                           ///< [1] part accounted to the fire layer
    base::MediaLayer layer = base::MediaLayer::Smoke; ///< of the rest

    std::unique_ptr<Solver> create(const base::SnapshotSchema& schema, const Quality& quality,
                                   std::pmr::memory_resource* memory) const override;
    uint32_t capacity() const override { return uint32_t(cells.size()); }
    bool publishes(const base::KindDesc& kind) const override;
    Influence influence() const override { return {}; }
    CatchUp catchUp() const override { return CatchUp::Analytic; }
    float reach(float gravity, float wind, float seconds) const override;

    /// [m] Center of the cells of a brick, in the space of the effect.
    glm::vec3 centerOf(const base::VolumeCells& brick) const;
    float voxelSide() const { return scale * (voxels ? voxels->side : 1.0f); } ///< [m]
};

} // namespace fx::sim
