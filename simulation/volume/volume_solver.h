/// @file volume_solver.h
/// A medium that does not move, on sparse voxels. It is the same at all times.
#pragma once

#include "foundation/assets/asset_table.h"
#include "simulation/detail/field_detail.h"
#include "simulation/solver/still_medium.h"

#include <memory>
#include <vector>

namespace fx::sim {

struct VolumeDef final : StillMediumDef
{
    std::shared_ptr<const base::VoxelVolume> voxels;
    base::AssetId asset = 0;              ///< id of `voxels` in the asset table
    std::vector<base::VolumeCells> cells; ///< volumeCells() of `voxels`
    FieldDetail detail;                   ///< fixed in the volume

    std::unique_ptr<Solver> create(const base::SnapshotSchema& schema, const Quality& quality,
                                   std::pmr::memory_resource* memory) const override;
    uint32_t capacity() const override { return uint32_t(cells.size()); }
    bool publishes(const base::KindDesc& kind) const override;
    uint64_t bytes() const override;
    float reach(float gravity, float wind, float seconds) const override;
};

} // namespace fx::sim
