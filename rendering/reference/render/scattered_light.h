/// @file scattered_light.h
/// Light of the sun and of glowing gas that the medium scatters once, by a shadow ray from every place where
/// it may.
#pragma once

#include "rendering/reference/render/medium_view.h"
#include "rendering/reference/render/opaque_view.h"

#include <array>
#include <vector>

namespace fx::render {

/// @formula single-scattering
/// Light that reaches the eye along a ray after one scattering.
///
/// symbol    unit    meaning
///   t       m       ray parameter; T its transmittance from the ray's beginning
///   a_i     1       albedo of blob i; rho_i [1/m] its extinction; p_i [1/sr] its phase function
///   E_l     lx      illuminance of light l with nothing in its way
///   T_l     1       transmittance of the medium towards the light, 0 behind a triangle
///   S       cd/m2   the scattered light
/// @derivation
///   Light scattered into the ray at t: j = sum over i and l of a_i rho_i p_i(cosine) E_l T_l        (1)
///   S = integral of T j dt                                                                     (2)
///   The integrand is smooth between the places where blobs begin and end: 3 Gauss-Legendre nodes there, in
///   as many parts as the optical depth requires. T and T_l are exact sums of polynomials.
/// @source    [HG41] for the phase function; (1) and (2) are the textbook integral
/// @deviation glowing groups are balls: what is inside their radius is taken as already counted in their
/// light
/// @valid     single scattering only: bright smoke looks too dark
/// @accuracy  |error of S| <= 2e-3 S for optical depths up to 10 along ray and shadow rays
/// @tests     tests/rendering/reference/render/test_scattered_light.cpp
///
/// One for each thread.
class ScatteredLight
{
public:
    using Layers = std::array<glm::dvec3, 3>; ///< by MediaLayer

    /// @param medium, opaque must outlive this
    ScatteredLight(const MediumView& medium, const OpaqueView& opaque) : medium_(medium), opaque_(opaque) {}

    /// @param hits all blobs that the ray meets between its parameters `begin` and `end`
    Layers along(const TraceRay& ray, const RayHits& hits, double begin, double end);

private:
    /// A piece of the ray and its optical depth.
    struct Interval
    {
        double from, to, depth;
    };
    void addInterval(const TraceRay& ray, const RayHits& hits, double begin, const Interval& interval,
                     Layers& io);
    void addPart(const TraceRay& ray, const RayHits& hits, double begin, double from, double to, Layers& io);
    void addNode(const TraceRay& ray, const RayHits& hits, double t, double weight, Layers& io);
    double transmittance(const glm::dvec3& point, const glm::dvec3& direction, double distance);

    const MediumView& medium_;
    const OpaqueView& opaque_;
    std::vector<double> events_;
    RayHits shadowHits_;
};

} // namespace fx::render
