#include "rendering/techniques/draw_techniques.h"

#include "foundation/snapshot/particle_bounds.h"
#include "rendering/particle_rows/row_casters.h"
#include "rendering/particle_rows/row_technique.h"
#include "rendering/techniques/rows/row_view.h"

#include <glm/geometric.hpp>
#include <glm/gtc/packing.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace fx::render {

namespace {

namespace column = base::ribbon_column;

bool isThere(const base::SnapshotGroup& group)
{
    return group.info().count > 1;
}

BatchShape shapeOf(const base::SnapshotGroup&)
{
    return BatchShape::Ribbon;
}

uint32_t rowsOf(const base::SnapshotGroup& group)
{
    return group.count();
}

/// The piece from row i to the next.
RowCard cardAt(const base::SnapshotGroup& group, size_t i)
{
    const auto pointAt = [&](size_t row) {
        return glm::vec3(group.column(column::PositionX)[row], group.column(column::PositionY)[row],
                         group.column(column::PositionZ)[row]);
    };
    const auto strips = group.column64(column::Strip);
    const bool isPiece = strips[i] == strips[i + 1];
    const glm::vec3 begin = pointAt(i);
    const glm::vec3 end = isPiece ? pointAt(i + 1) : begin;
    return {0.5f * (begin + end), 2.0f * group.column(column::HalfWidth)[i] * glm::distance(begin, end)};
}

/// Pieces as balls. Balls in a row, each of the cross section s and the radius r on a length l, have the
/// optical depth (35 / 32) s / (r l) through the middle of the row, which here is that of the ribbon.
RowBall ballOf(const base::SnapshotGroup& group, uint32_t first, uint32_t count)
{
    RowBall ball;
    const float blend = group.constants()[base::particle_constant::Blend];
    if (blend == float(base::ParticleBlend::Additive))
        return ball;
    const bool isSolid = blend == float(base::ParticleBlend::Opaque);
    const auto halfWidth = group.column(column::HalfWidth);
    const auto color = group.column64(column::Color);
    for (uint32_t i = first; i < first + count; ++i) {
        const RowCard card = cardAt(group, i);
        const float width = halfWidth[i];
        if (!(card.area > 0.0f) || !(width > 0.0f))
            continue;
        const float length = card.area / (2.0f * width);
        const float alpha = std::abs(glm::unpackHalf1x16(uint16_t(color[i] >> 48)));
        const float depth = depthOfOpacity(isSolid ? (alpha >= 0.5f ? 1.0f : 0.0f) : alpha);
        const float section = (32.0f / 35.0f) * depth * width * length;
        if (!(section > 0.0f))
            continue;
        if (ball.ownSection == 0.0f)
            ball = {i, card.center, std::max(width, 0.5f * length), section, 0.0f};
        ball.crossSection += section;
    }
    return ball;
}

/// What is read of the strip is whether a row goes on with that of the row before: the color says so.
constexpr base::ColumnSet kDrawn = ~(uint64_t(1) << column::Strip);

constexpr base::ColumnSet setOf(size_t c)
{
    return base::ColumnSet(1) << c;
}

constexpr RowMerge kMerge{
    .radius = column::HalfWidth,
    .strip = column::Strip,
    .copied = setOf(column::Arc) | setOf(column::Color) | setOf(column::Strip) | setOf(column::Age),
};

constexpr RowTechnique kRows{
    &base::kRibbonKind, true,    false, base::kRibbonColumns, kDrawn, isThere, shapeOf, rowsOf, cardAt,
    base::ribbonBounds, &kMerge, ballOf};

constexpr TimedPass kPasses[] = {{"scene distance"}, {"media", "media"}, {"composite"}};

std::span<const ProgramDesc* const> programs()
{
    static const std::array<const ProgramDesc*, 4> all{
        &particleProgram(BatchShape::Ribbon, false, false), &particleProgram(BatchShape::Ribbon, false, true),
        &particleProgram(BatchShape::Ribbon, true, false), &particleProgram(BatchShape::Ribbon, true, true)};
    return all;
}

} // namespace

constexpr DrawTechnique kRibbonTechnique{
    .name = "ribbons",
    .kind = &base::kRibbonKind,
    .rows = &kRows,
    .create = makeRowView,
    .programs = programs,
    .passes = kPasses,
};

} // namespace fx::render
