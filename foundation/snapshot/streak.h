/// @file streak.h
/// Motion blur of a moving ball: balls at equal distances along its path, each with its share of the medium,
/// close enough to look like a line that runs out behind the ball.
#pragma once

#include <algorithm>

namespace fx::base {

inline constexpr int kMaxStreakPieces = 64; ///< bounds what one ball costs

/// The balls of one streak. Ball k of `count` is centered k / count of the way behind the moving ball.
template <typename Real>
struct Streak
{
    int count;   ///< 1 .. kMaxStreakPieces
    Real radius; ///< of each

    /// [1] of the medium that is in ball k; falls evenly, and is 1 over all balls.
    Real shareOf(int k) const { return Real(2 * (count - k)) / Real(count * (count + 1)); }
};

/// Neighbors are at most a radius apart. Where kMaxStreakPieces balls of `radius` would leave
/// gaps, they are as wide as the distance between them.
/// @param length of the way while the shutter is open, >= 0 and finite
/// @param radius of the ball, > 0, in the same unit
template <typename Real>
Streak<Real> streakOf(Real length, Real radius)
{
    const Real gaps = length / radius; // compared before the conversion, which it may exceed
    const int count = gaps < Real(kMaxStreakPieces) ? int(gaps) + 1 : kMaxStreakPieces;
    return {count, std::max(radius, length / Real(kMaxStreakPieces))};
}

} // namespace fx::base
