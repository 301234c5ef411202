#include "simulation/volume/volume_solver.h"

#include "foundation/snapshot/material_kind.h"
#include "foundation/snapshot/volume_kind.h"
#include "simulation/volume/brick_balls.h"

#include <algorithm>

namespace fx::sim {
namespace {

BrickPlace placeOf(const VolumeDef& def)
{
    return {def, def.voxels ? def.voxels->origin : glm::vec3(0.0f), def.voxels ? def.voxels->side : 1.0f};
}

class VolumeSolver final : public StillMediumSolver
{
public:
    VolumeSolver(const VolumeDef& def, const base::SnapshotSchema& schema) : def_(def), kinds_(schema) {}

    void publish(const base::GroupInfo& base, base::FrameSnapshot& snapshot) const override
    {
        if (kinds_.blobs == base::kNoKind || def_.cells.empty())
            return;
        BrickBalls{def_, placeOf(def_), def_.cells, def_.capacity(), def_.asset, def_.detail}.publish(
            base, kinds_, snapshot);
    }

    uint32_t elementCount() const override { return def_.capacity(); }

private:
    const VolumeDef& def_;
    VolumeKinds kinds_;
};

} // namespace

std::unique_ptr<Solver> VolumeDef::create(const base::SnapshotSchema& schema, const Quality&,
                                          std::pmr::memory_resource*) const
{
    return std::make_unique<VolumeSolver>(*this, schema);
}

bool VolumeDef::publishes(const base::KindDesc& kind) const
{
    return kind == base::kBlobKind || kind == base::kVolumeKind ||
           (detail.given && kind == base::kMaterialKind);
}

uint64_t VolumeDef::bytes() const
{
    return detail.given ? capacity() * kBrickMaterialBytes : 0;
}

float VolumeDef::reach(float, float, float) const
{
    float farthest = 0.0f;
    for (const base::VolumeCells& own : cells)
        farthest = std::max(farthest, placeOf(*this).reachOf(own.brick));
    return farthest;
}

} // namespace fx::sim
