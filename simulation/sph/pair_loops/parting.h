/// @file parting.h
/// The direction in which coincident particles push each other apart: equation (6) of formula
/// gas-pair-forces.
#pragma once

#include "foundation/math/hash.h"

#include <array>
#include <cmath>
#include <cstdint>

namespace fx::sim {

/// [1] Distance divided by the mean support, below which a pair has no defined direction.
constexpr double kCoincident = 1e-6;
/// [1] Distance divided by the mean support, at which the kernel of coincident pairs is evaluated.
constexpr double kPartingDistance = 0.05;

/// Unit vector from the particle `other` towards the particle `id`. Exchanged arguments give exactly the
/// opposite vector.
template <class T>
std::array<T, 3> partingDirection(uint32_t id, uint32_t other)
{
    const uint32_t first = id < other ? id : other;
    const uint32_t second = id < other ? other : id;
    const uint64_t bits = base::hashWord(base::hashWord(0, first), second);
    std::array<T, 3> direction;
    T square = 0;
    for (uint32_t a = 0; a < 3; ++a) {
        // Odd numbers between -2^20 and 2^20: never 0, exact in float.
        const int number = int((bits >> (20 * a)) & 0xFFFFF) * 2 + 1 - (1 << 20);
        direction[a] = T(number);
        square += direction[a] * direction[a];
    }
    const T scale = (id < other ? T(1) : T(-1)) / std::sqrt(square);
    for (T& x : direction)
        x *= scale;
    return direction;
}

} // namespace fx::sim
