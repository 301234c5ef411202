/// @file depth_keys.h
/// Distances of a group's rows, and whole numbers that sort like them: loops over whole columns, compiled for
/// each instruction set.
#pragma once

#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>

namespace fx::render {

constexpr uint32_t kAbsentKey = ~0u; ///< of what is no number

/// What a list of keys is like.
struct KeySpan
{
    uint32_t lowest, highest; ///< of those that are not kAbsentKey; both 0 when there is none
    uint32_t absent;          ///< how many are kAbsentKey
    uint32_t newcomers;       ///< how many are not, but were in the list before
};

/// Keys whose rising order is that of the values, or their falling order with flip = ~0.
/// @param last keys of the list before
KeySpan makeKeys(const float* values, uint32_t flip, const uint32_t* last, uint32_t* outKeys, size_t count);

/// Columns of one group.
struct RowColumns
{
    const float *x, *y, *z, *radius; ///< [m]
    size_t count;
};

/// Distance of each row from `eye`, or, with `isParallel`, along the unit vector `eye`; NaN for rows whose
/// radius is not above 0.
/// @param scale, offset what is written is distance * scale + offset  @param out [m]
void rowDistances(const RowColumns& rows, const glm::vec3& eye, bool isParallel, float scale, float offset,
                  float* out);

} // namespace fx::render
