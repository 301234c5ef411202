/// @file ray_records.h
/// Inputs and results of the integral for one ray.
///
/// Ray parameters may be counted from any point of the ray. Choose an origin near the blobs, and compute them
/// in double: a float of 1e5 m resolves 8 mm.
#pragma once

#include <array>
#include <cstdint>

namespace fx::render {

/// A blob as one ray meets it. Extinction at parameter t is
///     extinction ((chord2 - (t - center)^2) / radius^2)^degree,
/// which is the kernel (1 - q^2)^degree, q the distance from the blob's center in radii.
template <class T>
struct RayBlob
{
    T center;                ///< [m] ray parameter of the point nearest to the blob's center
    T chord2;                ///< [m2] square of half the chord, radius^2 - distance^2; <= 0: the ray misses
    T radius;                ///< [m] > 0
    T extinction;            ///< [1/m] at the blob's center, >= 0
    std::array<T, 3> source; ///< [cd/m2] (1 - albedo) emission, >= 0
    uint32_t id;             ///< different for every blob of a ray: the order of summation
};

/// The visible part of the ray, and the background behind it.
template <class T>
struct RayWindow
{
    T nearest;                   ///< [m]
    T farthest;                  ///< [m] scene depth, may be +infinity
    std::array<T, 3> background; ///< [cd/m2]
};

enum RayFlag : uint32_t
{
    kRayInvalid = 1,  ///< a number was not finite or had a forbidden sign: the result is all zero
    kRayStopped = 2,  ///< ended at the scheme's stopDepth (or bound); the rest is dark
    kRayFallback = 4, ///< some part was thicker than the cap after 64 parts: Positive was used there
    kRayTooSmall = 8  ///< a blob was too small beside the largest for the arithmetic, and was left out
};

template <class T>
struct RayLight
/// [cd/m2] with the background
{
    std::array<T, 3> radiance;
    T opticalDepth;  ///< [1] up to where the ray ended
    T transmittance; ///< [1] 0..1
    uint32_t flags;
};

/// Work done, for reports beside times. Sums over all rays of all calls.
struct RayWork
{
    uint64_t rays = 0;
    uint64_t hits = 0;      ///< blobs that rays meet
    uint64_t intervals = 0; ///< of positive length
    uint64_t parts = 0;     ///< of intervals; March: steps
    uint64_t blobSums = 0;  ///< evaluations of one blob's polynomial or kernel
    uint64_t nodes = 0;     ///< quadrature nodes
    uint64_t exponentials = 0;

    RayWork& operator+=(const RayWork& other);
};

} // namespace fx::render
