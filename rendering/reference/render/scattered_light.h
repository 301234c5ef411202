/// @file scattered_light.h
/// Computes single scattering of the light of a scene in a medium, by shadow rays from points along each ray.
#pragma once

#include "rendering/reference/render/medium_view.h"
#include "rendering/reference/render/scene_lights.h"
#include "rendering/reference/render/shadow_ray.h"

#include <array>
#include <vector>

namespace fx::render {

/// @formula single-scattering
/// Light that reaches the eye along a ray after exactly one scattering.
///
/// symbol    unit    meaning
///   t       m       ray parameter; T transmittance from the beginning of the ray to t
///   a_i     1       albedo of blob i; rho_i [1/m] its extinction; p_i [1/sr] its phase function
///   E_l     lx      illuminance of light l without attenuation
///   T_l     1       transmittance of the medium towards the light, 0 if a triangle blocks it
///   L_j     cd/m2   luminance of sky or ground in direction j, w_j [sr] the weight of the direction
///   t_n, d  m       ray parameter nearest to a lamp and the distance there, at least the lamp's extent
///   S       cd/m2   the scattered light
/// @derivation
///   Light scattered into the ray at t:
///   j = sum over i of a_i rho_i (A_i + sum over l of p_i(cosine) E_l T_l)                        (1)
///   for the sky, A_i = sum over j of p_i w_j L_j T_j / sum over j of p_i w_j                    (2)
///   S = integral of T j dt                                                                     (3)
///   The integrand is smooth between the points where blobs begin and end. Each such interval is divided into
///   as many parts as its optical depth requires, with 3 Gauss-Legendre nodes each. T and T_l are exact sums
///   of polynomials. For media with detail, T is that of detailed-ray-integral, and parts are at most as long
///   as a quarter of the largest lumps. The illuminance of a lamp has a peak at t_n. With the variable v,
///   t = t_n + d tan(v), the integrand is nearly constant                                          (4)
/// @source    [HG41] for the phase function; (1) to (3) are textbook integrals; v in (4) is the angle
///            at the lamp
/// @deviation glowing groups are balls, and medium within their radius does not attenuate their light. (2) is
///            divided by its sum of weights, so that a uniform sky around thin media is exact. The directions
///            of sky-quadrature and cone-quadrature are shifted from node to node.
/// @valid     single scattering only: bright smoke is too dark, and surfaces do not illuminate media
/// @accuracy  sun, points and spots: |error of S| <= 2e-3 S for optical depths up to 10 along ray and shadow
///            rays. Sky: root mean square error over rays through 60 blobs 3e-2, 1.5e-2, 1.25e-2, 5e-3 S with
///            16, 36, 64, 144 directions
/// @tests     tests/rendering/reference/render/test_scattered_light.cpp
///
/// Each thread needs its own object.
class ScatteredLight
{
public:
    using Layers = std::array<glm::dvec3, 3>; ///< light by MediaLayer

    /// @param medium, opaque, lights objects that must outlive this one
    ScatteredLight(const MediumView& medium, const OpaqueView& opaque, const SceneLights& lights)
        : medium_(medium), lights_(lights), shadow_(medium, opaque),
          detailed_(medium, DetailedRay::Wanted::Depth, kDetailTolerance)
    {}

    /// [cd/m2] Scattered light along a ray, by layer.
    /// @param hits all blobs that the ray meets between its parameters `begin` and `end`
    Layers along(const TraceRay& ray, const RayHits& hits, double begin, double end);

private:
    struct Ray
    {
        const TraceRay& ray;
        const RayHits& hits;
        double begin;
    };
    struct Interval
    {
        double from, to;
    };
    static constexpr double kDetailTolerance = 1e-3;
    static constexpr size_t kDistant = size_t(-1); ///< index of a lamp that denotes sun and sky

    void findEvents(const Ray& ray, double end);
    double opticalDepth(const Ray& ray, double from, double to) const;
    void addInterval(const Ray& ray, const Interval& interval, Layers& io);
    void addParts(const Ray& ray, const Interval& interval, size_t lamp, Layers& io);
    void addPart(const Ray& ray, const Interval& part, Layers& io);
    void addLampPart(const Ray& ray, const Interval& part, size_t lamp, Layers& io);
    void addNode(const Ray& ray, double t, double length, size_t lamp, Layers& io);
    /// [cd/m2 per optical depth of scattering] Light that is scattered to the eye at the current node.
    glm::dvec3 inflow(const glm::dvec3& look, float anisotropy) const;

    const MediumView& medium_;
    const SceneLights& lights_;
    ShadowRay shadow_;
    DetailedRay detailed_; ///< optical depth along the ray, for media with detail
    std::vector<double> events_;
    SceneLights::Course course_;
    std::vector<ArrivingLight> arriving_; ///< light from each direction at the current node
    size_t firstOfSky_ = 0;               ///< index in `arriving_` of the first direction of the sky
    uint32_t node_ = 0;
};

} // namespace fx::render
