/// @file block_directions.h
/// A grid of directions, from which the tiles of blocks are made.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cstdint>

namespace fx::render {

/// Unit vectors of a tile, in the space of the block.
struct TileAxes
{
    glm::vec3 right, up;
    glm::vec3 along; ///< from the eye to the block; right, up and along are orthogonal
};

/// The octahedral map of all directions, divided into cells x cells squares.
/// @param cells 1 to kMaxDirectionCells
constexpr int kMaxDirectionCells = 4096;

/// The cell of a unit vector.
glm::ivec2 directionCell(const glm::vec3& direction, int cells);
/// The axes of the middle of a cell. Cells outside of the map, by up to one cell, are those beyond its
/// border.
TileAxes axesOfCell(const glm::ivec2& cell, int cells);
/// The cell that is `step` away, across the border of the map where necessary.
glm::ivec2 neighborCell(const glm::ivec2& cell, const glm::ivec2& step, int cells);
/// The smallest number of cells, a power of 2 up to kMaxDirectionCells, with which nearly all cells are
/// smaller than `angle` [rad] from their middle, and `direction` is no farther from the middle of its cell.
int cellsForAngle(const glm::vec3& direction, float angle);

} // namespace fx::render
