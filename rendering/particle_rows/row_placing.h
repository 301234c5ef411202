/// @file row_placing.h
/// Transforms the rows of many groups to one space. The loops run over whole SIMD vectors and are compiled
/// for each instruction set. Results are bit-identical for all instruction sets.
#pragma once

#include "foundation/snapshot/pooled_groups.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <span>

namespace fx::render {

/// The rows of one group, and their transform. Rows may be transformed in place. Up to kRowsBehind rows
/// after the end are read.
struct PlacedRows
{
    const float* from[3]; ///< columns of the x, y and z components
    const float* radius;  ///< [m] column of radii; > 0 if the row contains a visible particle
    float* to[3];
    float* toRadius;
    uint32_t count;
    glm::quat rotation;
    float scale;
    glm::vec3 offset;       ///< [m]
    base::RowExtent extent; ///< result: extent of non-empty rows, with their radii
};

constexpr uint32_t kRowsBehind = 16;

/// Transforms positions and radii: offset + rotation * (scale * position), scale * radius. Also sets
/// `extent` to the extent before the transform.
void placeRows(std::span<PlacedRows> groups);

/// Transforms directions: rotation * (scale * direction). Radii do not change.
void turnRows(std::span<const PlacedRows> groups);

} // namespace fx::render
