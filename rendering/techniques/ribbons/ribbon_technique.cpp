#include "rendering/techniques/ribbons/ribbon_technique.h"

#include "foundation/snapshot/particle_bounds.h"
#include "rendering/particle_rows/row_technique.h"
#include "rendering/techniques/rows/row_view.h"

#include <glm/geometric.hpp>

#include <array>

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
    &base::kRibbonKind, true,   false, base::kRibbonColumns, kDrawn, isThere, shapeOf, rowsOf, cardAt,
    base::ribbonBounds, &kMerge};

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
};

} // namespace fx::render
