/// @file streak.h
/// Motion blur of a moving ball. The ball is replaced by balls at equal distances along its path, each with a
/// fraction of the medium. The replacing balls are close enough to look like a line that fades out behind the
/// moving ball.
#pragma once

#include <algorithm>

namespace fx::base {

/// Largest number of balls in a streak; limits the cost of one moving ball.
inline constexpr int kMaxStreakPieces = 64;

/// The balls of one streak. The center of ball k of `count` is behind the moving ball by k / count of the
/// path length.
template <typename Real>
struct Streak
{
    int count;   ///< number of balls, 1 .. kMaxStreakPieces
    Real radius; ///< radius of each ball, in the unit of the arguments

    /// [1] fraction of the medium in ball k. The fraction decreases linearly with k; the sum over all balls
    /// is 1.
    Real shareOf(int k) const { return Real(2 * (count - k)) / Real(count * (count + 1)); }
};

/// Computes the streak of a moving ball. Neighboring centers are at most one radius apart. If
/// kMaxStreakPieces balls of `radius` are too few for this distance, the radius is increased to the distance
/// of neighboring centers.
/// @param length length of the path while the shutter is open, >= 0 and finite
/// @param radius radius of the moving ball, > 0, in the same unit
template <typename Real>
Streak<Real> streakOf(Real length, Real radius)
{
    const Real gaps = length / radius; // compared as Real, because `gaps` may exceed the range of int
    const int count = gaps < Real(kMaxStreakPieces) ? int(gaps) + 1 : kMaxStreakPieces;
    return {count, std::max(radius, length / Real(kMaxStreakPieces))};
}

} // namespace fx::base
