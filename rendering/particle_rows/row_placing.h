/// @file row_placing.h
/// Rows of many groups are carried into one space: loops over whole vectors, compiled for each instruction
/// set. All give the same bits.
#pragma once

#include "foundation/snapshot/pooled_groups.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <span>

namespace fx::render {

/// The rows of one group, which may be transformed in place. Up to kRowsBehind rows after the end are read.
struct PlacedRows
/// columns of a vector
{
    const float* from[3];
    const float* radius; ///< [m]; above 0 where a row contains a visible particle
    float* to[3];
    float* toRadius;
    uint32_t count;
    glm::quat rotation;
    float scale;
    glm::vec3 offset;       ///< [m]
    base::RowExtent extent; ///< bounds of non-empty rows, with their radii
};

constexpr uint32_t kRowsBehind = 16;

/// Places and radii: offset + rotation * (scale * place), scale * radius. Measures the rows as they were.
void placeRows(std::span<PlacedRows> groups);

/// Directions: rotation * (scale * direction). Radii are not touched.
void turnRows(std::span<const PlacedRows> groups);

} // namespace fx::render
