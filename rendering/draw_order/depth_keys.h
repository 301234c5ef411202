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
    uint32_t changed;         ///< how many are others than before
    uint32_t newcomers;       ///< how many of those were kAbsentKey
};

/// Sets of elements: element i is bit i % 8 of byte i / 8, with room for a multiple of 64 bits.
struct KeyChanges
{
    uint8_t* changed;
    uint8_t* newcomers;
};

/// Keys whose rising order is that of the values, or their falling order with flip = ~0.
/// @param ioKeys those of the list before, which are replaced  @param out what else is written
KeySpan makeKeys(const float* values, uint32_t flip, uint32_t* ioKeys, const KeyChanges& out, size_t count);

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
