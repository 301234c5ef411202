#include "rendering/techniques/draw_techniques.h"

#include "foundation/snapshot/particle_bounds.h"
#include "rendering/particle_rows/row_casters.h"
#include "rendering/particle_rows/row_technique.h"
#include "rendering/techniques/rows/row_view.h"

#include <glm/geometric.hpp>
#include <glm/gtc/packing.hpp>

#include <array>
#include <cmath>

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

/// Rows as balls of their own sizes; streaks and wide sprites as balls of the same area.
RowBall ballOf(const base::SnapshotGroup& group, uint32_t first, uint32_t count)
{
    RowBall ball;
    const auto c = group.constants();
    const float blend = c[constant::Blend];
    if (blend == float(base::ParticleBlend::Additive))
        return ball;
    const bool isSolid = blend == float(base::ParticleBlend::Opaque);
    const bool isMesh = c[constant::Shape] == float(base::ParticleShape::Mesh);
    const bool isAlong = !isMesh && c[constant::Alignment] == float(base::SpriteAlignment::Velocity) &&
                         group.has(column::VelocityX);
    const float wide = isMesh ? 1.0f : c[constant::Aspect];
    const auto radius = group.column(column::Radius);
    const auto color = group.column64(column::Color);
    const auto vectorOf = [&](size_t k, uint32_t row) {
        return glm::vec3(group.column(k)[row], group.column(k + 1)[row], group.column(k + 2)[row]);
    };
    for (uint32_t row = first; row < first + count; ++row) {
        if (!(radius[row] > 0.0f))
            continue;
        const float alpha = glm::unpackHalf1x16(uint16_t(color[row] >> 48));
        const float depth = depthOfOpacity(isSolid ? (alpha >= 0.5f ? 1.0f : 0.0f) : alpha);
        const float high = isAlong ? radius[row] + 0.5f * c[constant::Stretch] *
                                                       glm::length(vectorOf(column::VelocityX, row))
                                   : radius[row];
        const float reach = std::sqrt(wide * radius[row] * high);
        const float section = crossSectionOfDepth(depth, reach);
        if (!(section > 0.0f))
            continue;
        if (ball.ownSection == 0.0f)
            ball = {row, vectorOf(column::PositionX, row), reach, section, 0.0f};
        ball.crossSection += section;
    }
    return ball;
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
                             &kMerge,
                             ballOf};

constexpr TimedPass kPasses[] = {{"scene distance"}, {"solid particles"}, {"media", "media"}, {"composite"}};

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
    .passes = kPasses,
};

} // namespace fx::render
