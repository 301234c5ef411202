/// @file scene_lights.h
/// Computes the light of a scene at a point, without attenuation, as a list of directions.
#pragma once

#include "rendering/reference/render/opaque_view.h"
#include "rendering/reference/trace/ray_grid.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cstddef>
#include <vector>

namespace fx::render {

/// Light from one direction.
struct ArrivingLight
{
    glm::dvec3 direction{0.0, 1.0, 0.0}; ///< unit vector towards the light
    glm::dvec3 illuminance{0.0};         ///< [lx] illuminance of a surface perpendicular to the light
    double distance =
        1e30; ///< [m] distance of the light; objects beyond this distance do not block the light
    /// [sr] solid angle that the direction represents; 0: the light has no extent
    double solidAngle = 0.0;
};

/// @formula cone-quadrature
/// Directions and weights that integrate a function over a cone.
///
/// symbol   unit   meaning
///   c      1      cosine of the angle to the axis, from c0 = 1 - h at the rim to 1
///   f      rad    angle about the axis
///   n, m   1      number of rings, and of directions per ring
///   dw     sr     weight
/// @derivation
///   c is at the n Gauss-Legendre nodes of [c0, 1] with weights w_i; f = 2 pi (j + turn) / m         (1)
///   dw = w_i 2 pi / m; the sum is the solid angle 2 pi h                                          (2)
/// @source    textbook: the product of two rules
/// @deviation none
/// @valid     n, m >= 1
/// @accuracy  exact for products of polynomials of degree 2 n - 1 in c and harmonics of f below m
/// @tests     tests/rendering/reference/render/test_scene_lights.cpp
///
/// @param axis unit  @param height h, 0..2
/// @param turn [1] rotation about the axis, over the step between directions, 0..1
/// @param out receives n m directions with their weights in `solidAngle`
void appendCone(const glm::dvec3& axis, double height, int rings, int sectors, double turn,
                std::vector<ArrivingLight>& out);

/// The lights of one scene. Coordinates are relative to the eye. Threads: any thread may call const
/// functions.
class SceneLights
{
public:
    static constexpr int kMaxSkyRings = 64;

    /// Builds the list of lights.
    /// @param skyRings number of rings of directions in each hemisphere, 1..kMaxSkyRings; each ring has 2
    ///         skyRings directions
    void build(const OpaqueScene& scene, const glm::dvec3& eye, int skyRings);

    bool hasSun() const { return sun_.illuminance != glm::dvec3(0.0); }
    const ArrivingLight& sun() const { return sun_; }

    /// Number of lamps: first the lights in the list of the scene, then the lights of glowing groups.
    size_t lampCount() const { return lamps_.size(); }
    /// Appends the light of a lamp at a point: one direction for a point light, a spot or a glowing group,
    /// many directions for a ball. The illuminance of a glowing group is finite everywhere, and objects
    /// within its extent do not block its light.
    /// @param turn [1] rotation of the directions, 0..1, see appendCone()
    void appendLamp(size_t lamp, const glm::dvec3& point, double turn, std::vector<ArrivingLight>& out) const;

    /// Variation of the light of a lamp along a ray.
    struct Course
    {
        double nearest;           ///< [m] ray parameter of the point nearest to the lamp
        double distance;          ///< [m] distance of this point from the lamp, at least the lamp's extent
        std::vector<double> cuts; ///< [m] ray parameters at which the light is not smooth, ascending
    };
    void course(size_t lamp, const TraceRay& ray, Course& out) const;

    /// @formula sky-quadrature
    /// Directions and weights that integrate a function over the sphere, separately for each hemisphere.
    ///
    /// symbol   unit   meaning
    ///   n      1      number of rings of a hemisphere
    ///   h      1      cosine of the angle to the vertical
    ///   f      rad    angle about the vertical
    ///   x, y   1      shift, 0..1
    ///   dw     sr     weight
    /// @derivation
    ///   h = (i + y) / n and f = 2 pi (j + x) / (2 n) for 0 <= i < n, 0 <= j < 2 n: equal weights
    ///   dw = 2 pi / (2 n^2)                                                                   (1)
    /// @source    elementary; shifts by a lattice are textbook
    /// @deviation none
    /// @valid     n >= 1
    /// @accuracy  with a shift of 1/2, second order like the midpoint rule. A mean over k shifts of a lattice
    ///            is about as accurate as k times as many directions
    /// @tests     tests/rendering/reference/render/test_scene_lights.cpp
    ///
    /// Appends the light of the sky and, below the horizon, of the ground: 4 n^2 directions, also without
    /// light.
    /// @param density n is this factor times `skyRings` of build()
    void appendSky(const glm::dvec2& shift, int density, std::vector<ArrivingLight>& out) const;
    bool hasSky() const { return sky_ != glm::dvec3(0.0) || ground_ != glm::dvec3(0.0); }
    const glm::dvec3& sky() const { return sky_; }       ///< [cd/m2] luminance above the horizon
    const glm::dvec3& ground() const { return ground_; } ///< [cd/m2] luminance below the horizon

private:
    struct Lamp
    {
        glm::dvec3 position, intensity;
        double radius;   ///< [m] radius of a ball, or extent of a glowing group
        bool isGroup;    ///< true: the lamp is a glowing group
        glm::dvec3 axis; ///< unit vector, direction of a spot
        /// [1] Cosines of a spot's inner and outer angle; -2 and below: light in all directions.
        double inner, outer;
        double ownReach = 0; ///< [m] see EffectLight
    };
    void appendBall(const Lamp& lamp, const glm::dvec3& point, double turn,
                    std::vector<ArrivingLight>& out) const;

    ArrivingLight sun_;
    glm::dvec3 sky_{0.0}, ground_{0.0};
    int skyRings_ = 1;
    std::vector<Lamp> lamps_;
};

} // namespace fx::render
