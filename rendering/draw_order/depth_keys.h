/// @file depth_keys.h
/// Computes the distances of a group's rows, and integer keys that have the same order. The loops run over
/// whole columns and are compiled for each instruction set.
#pragma once

#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>

namespace fx::render {

constexpr uint32_t kAbsentKey = ~0u; ///< key of elements whose value is NaN

/// Properties of a list of keys.
struct KeySpan
{
    uint32_t lowest, highest; ///< smallest and largest key other than kAbsentKey; both 0 if there are none
    uint32_t absent;          ///< number of keys that are kAbsentKey
    uint32_t changed;         ///< number of keys that differ from the previous list
    uint32_t newcomers;       ///< number of changed keys that were kAbsentKey in the previous list
};

/// Two sets of elements, as bits: element i is bit i % 8 of byte i / 8. Each array has space for a multiple
/// of 64 bits.
struct KeyChanges
{
    uint8_t* changed;
    uint8_t* newcomers;
};

/// Computes keys. Their ascending order is the ascending order of the values; with flip = ~0, it is the
/// descending order of the values.
/// @param flip 0 or ~0  @param ioKeys keys of the previous list; replaced by the new keys
/// @param out receives the sets of changed keys
KeySpan makeKeys(const float* values, uint32_t flip, uint32_t* ioKeys, const KeyChanges& out, size_t count);

/// Columns of one group.
struct RowColumns
{
    const float *x, *y, *z, *radius; ///< [m]
    size_t count;
};

/// Computes the distance of each row from the point `eye` or, with `isParallel`, along the unit vector `eye`.
/// Rows whose radius is not above 0 get NaN.
/// @param scale, offset the output is distance * scale + offset
/// @param out [m]
void rowDistances(const RowColumns& rows, const glm::vec3& eye, bool isParallel, float scale, float offset,
                  float* out);

} // namespace fx::render
