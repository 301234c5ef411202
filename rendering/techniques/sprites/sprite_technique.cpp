#include "rendering/techniques/sprites/sprite_technique.h"

#include "foundation/snapshot/particle_bounds.h"
#include "rendering/particle_rows/row_technique.h"
#include "rendering/techniques/rows/row_view.h"

#include <glm/geometric.hpp>

#include <array>

namespace fx::render {

namespace {

namespace column = base::particle_column;
namespace constant = base::particle_constant;

bool isThere(const base::SnapshotGroup& group)
{
    return group.info().count > 0;
}

BatchShape shapeOf(const base::SnapshotGroup& group)
{
    const bool isMesh = group.constants()[constant::Shape] == float(base::ParticleShape::Mesh);
    return isMesh ? BatchShape::Mesh : BatchShape::Sprite;
}

uint32_t rowsOf(const base::SnapshotGroup& group)
{
    return group.count();
}

RowCard cardAt(const base::SnapshotGroup& group, size_t i)
{
    const auto c = group.constants();
    const auto at = [&](size_t k) { return group.column(k)[i]; };
    const float radius = at(column::Radius);
    float high = radius;
    if (c[constant::Alignment] == float(base::SpriteAlignment::Velocity) && group.has(column::VelocityX)) {
        const glm::vec3 velocity(at(column::VelocityX), at(column::VelocityY), at(column::VelocityZ));
        high += 0.5f * c[constant::Stretch] * glm::length(velocity);
    }
    const glm::vec3 center(at(column::PositionX), at(column::PositionY), at(column::PositionZ));
    return {center, radius > 0.0f ? 4.0f * radius * c[constant::Aspect] * high : 0.0f};
}

base::Bounds boundsOf(const base::SnapshotGroup& group)
{
    return base::particleBounds(group, 1.0f, 0.0f);
}

constexpr base::ColumnSet setOf(size_t c)
{
    return base::ColumnSet(1) << c;
}

constexpr RowMerge kMerge{
    .radius = column::Radius,
    .velocity = column::VelocityX,
    .orientation = column::OrientationX,
    .copied = setOf(column::Age) | column::kAngle | column::kFrame | setOf(column::Color) | column::kIndex,
};

constexpr RowTechnique kRows{&base::kParticleKind,
                             false,
                             false,
                             base::kParticleColumns,
                             ~column::kIndex,
                             isThere,
                             shapeOf,
                             rowsOf,
                             cardAt,
                             boundsOf,
                             &kMerge};

std::span<const ProgramDesc* const> programs()
{
    static const auto all = [] {
        std::array<const ProgramDesc*, 8> list{};
        size_t end = 0;
        for (const BatchShape shape : {BatchShape::Sprite, BatchShape::Mesh})
            for (const bool isSolid : {false, true})
                for (const bool layers : {false, true})
                    list[end++] = &particleProgram(shape, isSolid, layers);
        return list;
    }();
    return all;
}

} // namespace

constexpr DrawTechnique kSpriteTechnique{
    .name = "sprites and meshes",
    .kind = &base::kParticleKind,
    .rows = &kRows,
    .create = makeRowView,
    .programs = programs,
};

} // namespace fx::render
