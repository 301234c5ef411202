#include "simulation/volume/brick_balls.h"

#include "foundation/snapshot/material_kind.h"

#include <algorithm>

namespace fx::sim {
namespace {

namespace blob = base::blob_column;

constexpr float kAir = 293.0f; ///< [K] a temperature that does not glow

/// [s] Older than any step: a brick that the snapshot before does not have is shown at once.
constexpr float kBorn = 1.0f;

uint64_t idOf(const glm::ivec3& brick, uint32_t lattice)
{
    constexpr auto kSide = uint64_t(base::kMaxVolumeBricksPerAxis);
    return uint64_t(brick.x) +
           kSide * (uint64_t(brick.y) + kSide * (uint64_t(brick.z) + kSide * uint64_t(lattice)));
}

} // namespace

VolumeKinds::VolumeKinds(const base::SnapshotSchema& schema)
    : blobs(schema.find(base::kBlobKind.name)), volumes(schema.find(base::kVolumeKind.name)),
      materials(schema.find(base::kMaterialKind.name))
{}

/// One generation, which does not end: the coordinate of a ball is its place.
void BrickBalls::addCoordinates(base::KindId kind, base::FrameSnapshot& snapshot) const
{
    DetailGenerations generations;
    const float side = detailSide > 0.0f ? detailSide : place.side;
    for (size_t g = 0; g < 2; ++g)
        generations.radius[g] = generations.radiusNow[g] = base::kVolumeBallRadius * side;
    base::SnapshotGroup& group = addMaterial(detail, generations, kind, capacity, snapshot);
    group.editConstants()[base::material_constant::Lossy] = 1.0f; // balls are too coarse to find the factor
    const base::SnapshotGroup& balls = snapshot.editGroup(snapshot.addedCount() - 2);
    std::ranges::copy(balls.ids(), group.editIds().begin());
    for (size_t g = 0; g < 2; ++g)
        for (size_t k = 0; k < 3; ++k)
            std::ranges::copy(balls.column(blob::PositionX + k),
                              group.editColumn(base::material_column::Place0X + 3 * g + k).begin());
}

void BrickBalls::publish(const base::GroupInfo& base, const VolumeKinds& kinds,
                         base::FrameSnapshot& snapshot) const
{
    const auto count = uint32_t(cells.size());
    BlobWriter writer(snapshot, base, kinds.blobs, count, capacity);
    StillMediumSolver::writeShared(def, writer);
    writer.fill(blob::Age, kBorn);
    writer.fill(blob::Radius, base::kVolumeBallRadius * place.side);
    for (uint32_t i = 0; i < count; ++i) {
        const base::VolumeCells& own = cells[i];
        const glm::vec3 center = place.centerOf(own.brick);
        for (int k = 0; k < 3; ++k) {
            writer.column(blob::PositionX + size_t(k))[i] = center[k];
            writer.column(blob::AlbedoR + size_t(k))[i] = own.albedo[k];
            writer.column(blob::EmissionR + size_t(k))[i] = own.emission[k];
        }
        writer.column(blob::CrossSection)[i] = def.sectionScale() * own.crossSection;
        writer.column(blob::Temperature)[i] = std::max(own.temperature, kAir);
        writer.ids()[i] = blobId(base.solver, idOf(own.brick, lattice));
    }
    writer.closeBounds();
    const base::Bounds bounds = writer.bounds();
    if (detail.given && kinds.materials != base::kNoKind)
        addCoordinates(kinds.materials, snapshot);
    if (kinds.volumes == base::kNoKind)
        return;
    base::SnapshotGroup& group = snapshot.addGroup(kinds.volumes, 0);
    base::GroupInfo& info = group.editInfo();
    info = base;
    info.kind = kinds.volumes;
    info.bounds = bounds;
    namespace c = base::volume_constant;
    const std::span<float> constants = group.editConstants();
    constants[c::Asset] = float(asset);
    constants[c::OriginX] = place.origin.x;
    constants[c::OriginY] = place.origin.y;
    constants[c::OriginZ] = place.origin.z;
    constants[c::Side] = place.side;
    constants[c::Density] = def.density / def.scale; // an optical depth keeps its value
    constants[c::Frame] = frame;
    constants[c::FrameBefore] = frameBefore;
    constants[c::FrameSeconds] = frameSeconds;
    constants[c::Lattice] = float(lattice);
    constants[c::Loops] = loops ? 1.0f : 0.0f;
}

} // namespace fx::sim
