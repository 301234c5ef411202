/// @file path_equiangular.h
/// Equiangular sampling: points on a ray near a light.
#pragma once

#include "rendering/reference/path/path_lights.h"
#include "rendering/reference/trace/ray_grid.h"

#include <utility>

namespace fx::render {

/// @formula equiangular-sampling
/// Samples points on a part of a ray with a density proportional to the illuminance by a nearby point light.
///
/// symbol   unit   meaning
///   d        m      distance of the light's center from the ray, at least the light's radius; c [m] ray
///                   parameter of the nearest point
///   a, b     m      ends of the part of the ray; A, B [rad] their angles at the light
///   t        m      sampled ray parameter; p its density [1/m]
/// @derivation
///   A = atan((a - c) / d), B = atan((b - c) / d)                                                       (1)
///   t = c + d tan(A + u (B - A))                                                                   (2)
///   p = d / ((B - A) (d^2 + (t - c)^2))                                                            (3)
/// @source    [KF12] Kulla, Fajardo, "Importance sampling techniques for path tracing in participating
///   media", doi:10.1111/j.1467-8659.2012.03148.x, section 3
/// @deviation d is at least the radius and 1e-6 of the part's length: (3) is the density of (2) for any
///            d > 0, and the light of a ball does not increase inside of it
/// @valid     a < b, finite
/// @accuracy  rounding
/// @tests     tests/rendering/reference/path/test_path_near_lights.cpp
class Equiangular
{
public:
    /// @param part [m] first and last ray parameter of the part that is sampled; first < second
    Equiangular(const TraceRay& ray, const std::pair<double, double>& part, const LightPlace& light);

    /// True if the sampling density varies much along the part, because the light is near.
    bool isNear() const { return isNear_; }
    double parameter(double u) const;       ///< [m] sampled ray parameter. @param u random number in [0, 1)
    double density(double parameter) const; ///< [1/m]

private:
    double begin_, end_;      ///< [m] ends of the part
    double nearest_, across_; ///< [m] c, d
    double from_, turn_;      ///< [rad] angles A and B - A
    bool isNear_;
};

} // namespace fx::render
