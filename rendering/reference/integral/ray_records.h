/// @file ray_records.h
/// Inputs and results of the integral for one ray.
///
/// Ray parameters may be measured from any point of the ray. Choose a point near the blobs and compute
/// parameters in double, because at 1e5 m the resolution of float is 8 mm.
#pragma once

#include <array>
#include <cstdint>

namespace fx::render {

/// A blob relative to one ray. Its extinction at parameter t is
///     extinction ((chord2 - (t - center)^2) / radius^2)^degree,
/// which is extinction (1 - q^2)^degree, where q is the distance from the blob's center in radii.
template <class T>
struct RayBlob
{
    T center; ///< [m] ray parameter of the point nearest to the blob's center
    /// [m2] Square of half the chord: radius^2 minus the squared distance of the center from the ray; if it
    /// is <= 0, the ray misses the blob.
    T chord2;
    T radius;                ///< [m] > 0
    T extinction;            ///< [1/m] extinction at the blob's center, >= 0
    std::array<T, 3> source; ///< [cd/m2] emission times (1 - albedo), >= 0
    uint32_t id;             ///< number that differs for all blobs of a ray; defines the order of summation
};

/// The visible part of a ray, and the background behind the ray.
template <class T>
struct RayWindow
{
    T nearest;  ///< [m]
    T farthest; ///< [m] ray parameter at which the ray ends, such as scene depth; may be +infinity
    std::array<T, 3> background; ///< [cd/m2]
};

enum RayFlag : uint32_t
{
    kRayInvalid = 1, ///< an input was not finite or had a wrong sign, so that the result is zero
    /// The optical depth reached stopDepth of the scheme, so that light from behind is omitted.
    kRayStopped = 2,
    /// a part exceeded the cap even after division into 64 parts, so that Positive was used for this part
    kRayFallback = 4,
    /// a blob was omitted, because it is too small relative to the largest blob for the precision
    kRayTooSmall = 8
};

template <class T>
struct RayLight
{
    std::array<T, 3> radiance; ///< [cd/m2] light of the blobs and attenuated background
    T opticalDepth;            ///< [1] optical depth up to the end of the ray
    T transmittance;           ///< [1] 0..1
    uint32_t flags;
};

/// Counters of work: sums over all rays of all calls.
struct RayWork
{
    uint64_t rays = 0;
    uint64_t hits = 0;      ///< number of blobs that rays meet
    uint64_t intervals = 0; ///< number of intervals of positive length
    uint64_t parts = 0;     ///< number of parts of intervals; March: number of steps
    uint64_t blobSums = 0;  ///< number of evaluations of a blob's polynomial or kernel
    uint64_t nodes = 0;     ///< number of quadrature nodes
    uint64_t exponentials = 0;

    RayWork& operator+=(const RayWork& other);
};

} // namespace fx::render
