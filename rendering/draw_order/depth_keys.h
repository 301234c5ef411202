/// @file depth_keys.h
/// Distances of a group's rows, and whole numbers that sort like them: loops over whole columns, compiled for
/// each instruction set.
#pragma once

#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>

namespace fx::render {

constexpr uint32_t kAbsentKey = ~0u; ///< key of NaN

/// Range and order of a list of keys.
struct KeySpan
{
    uint32_t lowest, highest; ///< of keys other than kAbsentKey; both 0 without such
    uint32_t absent;          ///< how many are kAbsentKey
    uint32_t changed;         ///< how many are others than before
    uint32_t newcomers;       ///< number of those that were kAbsentKey before
};

/// Sets of elements: element i is bit i % 8 of byte i / 8, with room for a multiple of 64 bits.
struct KeyChanges
{
    uint8_t* changed;
    uint8_t* newcomers;
};

/// Keys whose ascending order is that of the values, or their descending order with flip = ~0.
/// @param ioKeys keys of the previous list; replaced by the new ones @param out further outputs
KeySpan makeKeys(const float* values, uint32_t flip, uint32_t* ioKeys, const KeyChanges& out, size_t count);

/// Columns of one group.
struct RowColumns
{
    const float *x, *y, *z, *radius; ///< [m]
    size_t count;
};

/// Distance of each row from `eye`, or, with `isParallel`, along the unit vector `eye`; NaN for rows whose
/// radius is not above 0.
/// @param scale, offset the output is distance * scale + offset @param out [m]
void rowDistances(const RowColumns& rows, const glm::vec3& eye, bool isParallel, float scale, float offset,
                  float* out);

} // namespace fx::render
