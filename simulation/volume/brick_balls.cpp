#include "simulation/volume/brick_balls.h"

#include <algorithm>

namespace fx::sim {
namespace {

namespace blob = base::blob_column;

constexpr float kAir = 293.0f; ///< [K] a temperature that does not glow

uint64_t idOf(const glm::ivec3& brick)
{
    constexpr auto kSide = uint64_t(base::kMaxVolumeBricksPerAxis);
    return uint64_t(brick.x) + kSide * (uint64_t(brick.y) + kSide * uint64_t(brick.z));
}

} // namespace

void BrickBalls::publish(const base::GroupInfo& base, base::KindId blobs, base::KindId volumes,
                         base::FrameSnapshot& snapshot) const
{
    const auto count = uint32_t(cells.size());
    BlobWriter writer(snapshot, base, blobs, count, capacity);
    StillMediumSolver::writeShared(def, writer);
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
        writer.ids()[i] = blobId(base.solver, idOf(own.brick));
    }
    writer.closeBounds();
    if (volumes == base::kNoKind)
        return;
    const base::Bounds bounds = writer.bounds();
    base::SnapshotGroup& group = snapshot.addGroup(volumes, 0);
    base::GroupInfo& info = group.editInfo();
    info = base;
    info.kind = volumes;
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
}

} // namespace fx::sim
