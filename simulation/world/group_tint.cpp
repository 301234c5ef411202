#include "simulation/world/group_tint.h"

#include "foundation/math/half.h"
#include "foundation/snapshot/block_kind.h"
#include "foundation/snapshot/particle_kind.h"

namespace fx::sim {

namespace {

using base::SnapshotGroup;

/// Multiplies three columns from `column` on.
void multiply(const glm::vec3& tint, size_t column, SnapshotGroup& io)
{
    for (size_t k = 0; k < 3; ++k)
        for (float& value : io.editColumn(column + k).first(io.count()))
            value *= tint[int(k)];
}

void multiplyColors(const glm::vec3& tint, size_t column, SnapshotGroup& io)
{
    for (uint64_t& color : io.editColumn64(column).first(io.count())) {
        const auto part = [color](int k) { return base::fromHalf(uint32_t(color >> (16 * k)) & 0xFFFFu); };
        color = (color & 0xFFFF000000000000u) |
                base::packHalfs(tint.x * part(0), tint.y * part(1), tint.z * part(2), 0.0f);
    }
}

/// Equations (1) and (2), whose part of black bodies readers compute.
void tintMedium(const glm::vec3& tint, size_t shade, SnapshotGroup& io)
{
    for (size_t k = 0; k < 3; ++k)
        io.editConstants()[shade + k] = 1.0f - tint[int(k)];
    if (io.info().isLate)
        return; // its rows are made from those of other groups
    multiply(tint, base::blob_column::AlbedoR, io);
    multiply(tint, base::blob_column::EmissionR, io);
}

} // namespace

uint64_t tintGroups(const glm::vec3& tint, size_t first, base::FrameSnapshot& io)
{
    uint64_t rows = 0;
    for (size_t g = first; g < io.addedCount(); ++g) {
        SnapshotGroup& group = io.editGroup(g);
        const base::KindDesc& kind = io.schema().kind(group.info().kind);
        if (kind == base::kBlobKind)
            tintMedium(tint, base::blob_constant::ShadeR, group);
        else if (kind == base::kBlockBallKind)
            tintMedium(tint, base::block_ball_constant::ShadeR, group);
        else if (kind == base::kParticleKind)
            multiplyColors(tint, base::particle_column::Color, group); // (3)
        else if (kind == base::kRibbonKind)
            multiplyColors(tint, base::ribbon_column::Color, group);
        else if (kind == base::kLightKind)
            multiply(tint, base::light_column::IntensityR, group);
        else
            continue;
        rows += group.info().isLate ? 0 : group.count();
    }
    return rows;
}

} // namespace fx::sim
