#include "rendering/blocks/block_directions.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace fx::render {

namespace {

/// [rad] Angle between most directions and the middle of their cells, times the number of cells. At the edges
/// of the octahedron it is up to 4.2.
constexpr float kAngleOfCell = 2.5f;

float signOf(float x)
{
    return x < 0.0f ? -1.0f : 1.0f;
}

glm::vec2 folded(const glm::vec2& p)
{
    return {(1.0f - std::abs(p.y)) * signOf(p.x), (1.0f - std::abs(p.x)) * signOf(p.y)};
}

glm::vec2 mapOf(const glm::vec3& d)
{
    const glm::vec3 unit = d / std::max(std::abs(d.x) + std::abs(d.y) + std::abs(d.z), 1e-12f);
    const glm::vec2 p(unit.x, unit.y);
    return unit.z < 0.0f ? folded(p) : p;
}

glm::vec3 directionOf(const glm::vec2& p)
{
    const float z = 1.0f - std::abs(p.x) - std::abs(p.y);
    return glm::normalize(glm::vec3(z < 0.0f ? folded(p) : p, z));
}

} // namespace

glm::ivec2 directionCell(const glm::vec3& direction, int cells)
{
    const glm::vec2 p = (0.5f + 0.5f * mapOf(direction)) * float(cells);
    return glm::clamp(glm::ivec2(glm::floor(p)), glm::ivec2(0), glm::ivec2(cells - 1));
}

TileAxes axesOfCell(const glm::ivec2& cell, int cells)
{
    TileAxes axes;
    axes.along = directionOf((glm::vec2(cell) + 0.5f) * (2.0f / float(cells)) - 1.0f);
    const glm::vec3 other = std::abs(axes.along.y) < 0.9f ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0);
    axes.right = glm::normalize(glm::cross(axes.along, other));
    axes.up = glm::cross(axes.right, axes.along);
    return axes;
}

glm::ivec2 neighborCell(const glm::ivec2& cell, const glm::ivec2& step, int cells)
{
    glm::ivec2 next = cell + step;
    // Beyond a border of the map comes the same border, run through in the other direction.
    for (int axis = 0; axis < 2; ++axis)
        if (next[axis] < 0 || next[axis] >= cells) {
            next[axis] = next[axis] < 0 ? 0 : cells - 1;
            next[1 - axis] = cells - 1 - std::clamp(next[1 - axis], 0, cells - 1);
        }
    return next;
}

int cellsForAngle(const glm::vec3& direction, float angle)
{
    int cells = 1;
    while (cells < kMaxDirectionCells && kAngleOfCell > angle * float(cells))
        cells *= 2;
    const auto isFar = [&] {
        const glm::vec3 middle = axesOfCell(directionCell(direction, cells), cells).along;
        return glm::length(middle - direction) > 2.0f * std::sin(0.5f * std::min(angle, 3.0f));
    };
    while (cells < kMaxDirectionCells && isFar())
        cells *= 2;
    return cells;
}

} // namespace fx::render
