#include "simulation/volume/volume_solver.h"

#include "foundation/snapshot/volume_kind.h"

#include <glm/geometric.hpp>

#include <algorithm>

namespace fx::sim {
namespace {

namespace blob = base::blob_column;

constexpr float kAir = 293.0f; ///< [K] a temperature that does not glow

class VolumeSolver final : public StillMediumSolver
{
public:
    VolumeSolver(const VolumeDef& def, base::KindId blobs, base::KindId volumes)
        : def_(def), blobs_(blobs), volumes_(volumes)
    {}

    void publish(const base::GroupInfo& base, base::FrameSnapshot& snapshot) const override
    {
        if (blobs_ == base::kNoKind || def_.cells.empty())
            return;
        const base::Bounds bounds = publishBalls(base, snapshot);
        if (volumes_ == base::kNoKind)
            return;
        base::SnapshotGroup& group = snapshot.addGroup(volumes_, 0);
        base::GroupInfo& info = group.editInfo();
        info = base;
        info.kind = volumes_;
        info.bounds = bounds;
        namespace c = base::volume_constant;
        const std::span<float> constants = group.editConstants();
        const glm::vec3 origin = def_.position + def_.scale * def_.voxels->origin;
        constants[c::Asset] = float(def_.asset);
        constants[c::OriginX] = origin.x;
        constants[c::OriginY] = origin.y;
        constants[c::OriginZ] = origin.z;
        constants[c::Side] = def_.voxelSide();
        constants[c::Density] = def_.density / def_.scale; // an optical depth keeps its value
    }

    uint32_t elementCount() const override { return def_.capacity(); }

private:
    base::Bounds publishBalls(const base::GroupInfo& base, base::FrameSnapshot& snapshot) const
    {
        const uint32_t count = elementCount();
        BlobWriter writer(snapshot, base, blobs_, count, count);
        writeShared(def_, writer);
        writer.fill(blob::Radius, base::kVolumeBallRadius * def_.voxelSide());
        const float amount = def_.sectionScale();
        for (uint32_t i = 0; i < count; ++i) {
            const base::VolumeCells& cells = def_.cells[i];
            const glm::vec3 center = def_.centerOf(cells);
            for (int k = 0; k < 3; ++k) {
                writer.column(blob::PositionX + size_t(k))[i] = center[k];
                writer.column(blob::AlbedoR + size_t(k))[i] = cells.albedo[k];
                writer.column(blob::EmissionR + size_t(k))[i] = cells.emission[k];
            }
            writer.column(blob::CrossSection)[i] = amount * cells.crossSection;
            writer.column(blob::Temperature)[i] = std::max(cells.temperature, kAir);
            writer.ids()[i] = blobId(base.solver, i);
        }
        writer.closeBounds();
        return writer.bounds();
    }

    const VolumeDef& def_;
    base::KindId blobs_, volumes_;
};

} // namespace

std::unique_ptr<Solver> VolumeDef::create(const base::SnapshotSchema& schema, const Quality&,
                                          std::pmr::memory_resource*) const
{
    return std::make_unique<VolumeSolver>(*this, schema.find(base::kBlobKind.name),
                                          schema.find(base::kVolumeKind.name));
}

bool VolumeDef::publishes(const base::KindDesc& kind) const
{
    return kind == base::kBlobKind || kind == base::kVolumeKind;
}

glm::vec3 VolumeDef::centerOf(const base::VolumeCells& brick) const
{
    const glm::vec3 middle = float(base::kVolumeBrickSide) * (glm::vec3(brick.brick) + 0.5f);
    return position + scale * (voxels->origin + voxels->side * middle);
}

float VolumeDef::reach(float, float, float) const
{
    float farthest = 0.0f;
    for (const base::VolumeCells& brick : cells)
        farthest = std::max(farthest, glm::length(centerOf(brick)) + base::kVolumeBallRadius * voxelSide());
    return farthest * 1.0001f; // above rounding
}

} // namespace fx::sim
