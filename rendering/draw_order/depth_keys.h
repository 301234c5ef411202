/// @file depth_keys.h
/// Computes the distances of a group's rows, and integer keys that sort in the order of the distances. The
/// loops run over whole columns and are compiled for each instruction set.
#pragma once

#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>

namespace fx::render {

constexpr uint32_t kAbsentKey = ~0u; ///< key of elements whose value is NaN

/// Range and counts of a list of keys.
struct KeySpan
{
    /// Smallest and largest key other than kAbsentKey; both 0 if all keys are kAbsentKey.
    uint32_t lowest, highest;
    uint32_t absent;    ///< number of keys that are kAbsentKey
    uint32_t changed;   ///< number of keys that differ from the previous list
    uint32_t newcomers; ///< number of changed keys that were kAbsentKey in the previous list
};

/// Two bit sets of elements. The bit of element i is bit i % 8 of byte i / 8. The size of each array is a
/// multiple of 64 bits.
struct KeyChanges
{
    uint8_t* changed;
    uint8_t* newcomers;
};

/// Computes keys. With flip = 0, ascending keys correspond to ascending values. With flip = ~0, ascending
/// keys correspond to descending values.
/// @param flip 0 or ~0  @param ioKeys keys of the previous call; replaced by the new keys
/// @param out receives the sets of changed keys
KeySpan makeKeys(const float* values, uint32_t flip, uint32_t* ioKeys, const KeyChanges& out, size_t count);

/// Columns of the rows of one group of particles.
struct RowColumns
{
    const float *x, *y, *z, *radius; ///< [m]
    size_t count;
};

/// Computes the distance of each row from the point `eye`. With `isParallel`, `eye` is a unit vector, and
/// distances are measured along it. The result is NaN for rows with a radius that is not above 0.
/// @param scale, offset the output is distance * scale + offset
/// @param out [m]
void rowDistances(const RowColumns& rows, const glm::vec3& eye, bool isParallel, float scale, float offset,
                  float* out);

} // namespace fx::render
