/// @file scattered_light.h
/// Light of a scene that the medium scatters once, by shadow rays from every place where it may.
#pragma once

#include "rendering/reference/render/medium_view.h"
#include "rendering/reference/render/scene_lights.h"
#include "rendering/reference/render/shadow_ray.h"

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
///   L_j     cd/m2   luminance of sky or ground in direction j, w_j [sr] the weight of the direction
///   t_n, d  m       ray parameter nearest to a lamp and the distance there, at least the lamp's extent
///   S       cd/m2   the scattered light
/// @derivation
///   Light scattered into the ray at t:
///   j = sum over i of a_i rho_i (A_i + sum over l of p_i(cosine) E_l T_l)                        (1)
///   of the sky: A_i = sum over j of p_i w_j L_j T_j / sum over j of p_i w_j                     (2)
///   S = integral of T j dt                                                                     (3)
///   The integrand is smooth between the places where blobs begin and end: 3 Gauss-Legendre nodes there, in
///   as many parts as the optical depth requires. T and T_l are exact sums of polynomials. Of media with
///   detail T is that of detailed-ray-integral, and pieces are no longer than a quarter of the largest lumps.
///   Illuminance by a lamp has a peak where the ray passes it: t = t_n + d tan(v) makes it even in v    (4)
/// @source    [HG41] for the phase function; (1) to (3) are textbook integrals, (4) counts by the angle at
///   which the lamp sees the ray
/// @deviation glowing groups are balls: what is inside their radius is taken as already counted in their
///   light. (2) is divided by its own sum of weights, so that an even sky around thin media is exact. The
///   directions of sky-quadrature and cone-quadrature are shifted from node to node.
/// @valid     single scattering only: bright smoke looks too dark, and surfaces light no medium
/// @accuracy  of sun, points and spots |error of S| <= 2e-3 S for optical depths up to 10 along ray and
///   shadow rays. Of the sky root mean square over rays through 60 blobs: 3e-2, 1.5e-2, 1.25e-2, 5e-3 S with
///   16, 36, 64, 144 directions
/// @tests     tests/rendering/reference/render/test_scattered_light.cpp
///
/// One for each thread.
class ScatteredLight
{
public:
    using Layers = std::array<glm::dvec3, 3>; ///< by MediaLayer

    /// @param medium, opaque, lights must outlive this
    ScatteredLight(const MediumView& medium, const OpaqueView& opaque, const SceneLights& lights)
        : medium_(medium), lights_(lights), shadow_(medium, opaque),
          detailed_(medium, DetailedRay::Wanted::Depth, kDetailTolerance)
    {}

    /// @param hits all blobs that the ray meets between its parameters `begin` and `end`
    Layers along(const TraceRay& ray, const RayHits& hits, double begin, double end);

private:
    /// The ray whose light is summed.
    struct Ray
    {
        const TraceRay& ray;
        const RayHits& hits;
        double begin;
    };
    /// A piece of the ray.
    struct Interval
    {
        double from, to;
    };
    static constexpr double kDetailTolerance = 1e-3;
    static constexpr size_t kDistant = size_t(-1); ///< sun and sky instead of a lamp

    void findEvents(const Ray& ray, double end);
    double opticalDepth(const Ray& ray, double from, double to) const;
    void addInterval(const Ray& ray, const Interval& interval, Layers& io);
    void addParts(const Ray& ray, const Interval& interval, size_t lamp, Layers& io);
    void addPart(const Ray& ray, const Interval& part, Layers& io);
    void addLampPart(const Ray& ray, const Interval& part, size_t lamp, Layers& io);
    void addNode(const Ray& ray, double t, double length, size_t lamp, Layers& io);
    /// [cd/m2 per optical depth of scattering] that arrives and leaves along the ray.
    glm::dvec3 inflow(const glm::dvec3& look, float anisotropy) const;

    const MediumView& medium_;
    const SceneLights& lights_;
    ShadowRay shadow_;
    DetailedRay detailed_; ///< the ray whose light is summed, where the medium has detail
    std::vector<double> events_;
    SceneLights::Course course_;
    std::vector<ArrivingLight> arriving_; ///< at the current node
    size_t firstOfSky_ = 0;               ///< in `arriving_`
    uint32_t node_ = 0;
};

} // namespace fx::render
