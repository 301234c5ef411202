/// @file scene_lights.h
/// All light of a scene that reaches a point when nothing stands in its way, direction by direction.
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
    glm::dvec3 direction{0.0, 1.0, 0.0}; ///< unit, towards the light
    glm::dvec3 illuminance{0.0};         ///< [lx] on a surface that faces the light
    double distance = 1e30;              ///< [m] beyond it nothing blocks the light
    double solidAngle = 0.0;             ///< [sr] that the direction stands for; 0: of no extent
};

/// @formula cone-quadrature
/// Directions and weights that integrate a function over a cone.
///
/// symbol   unit   meaning
///   c      1      cosine of the angle to the axis, from c0 = 1 - h at the rim to 1
///   f      rad    angle about the axis
///   n, m   1      rings, and directions of each
///   dw     sr     weight
/// @derivation
///   c at the n Gauss-Legendre nodes of [c0, 1] with weights w_i, f = 2 pi (j + turn) / m            (1)
///   dw = w_i 2 pi / m; the sum is the solid angle 2 pi h                                          (2)
/// @source    textbook: the product of two rules
/// @deviation none
/// @valid     n, m >= 1
/// @accuracy  exact for products of polynomials of degree 2 n - 1 in c and harmonics of f below m
/// @tests     tests/rendering/reference/render/test_scene_lights.cpp
///
/// @param axis unit  @param height h, 0..2  @param turn [1] of the step between directions, 0..1
/// @param out receives n m directions with their weights in `solidAngle`
void appendCone(const glm::dvec3& axis, double height, int rings, int sectors, double turn,
                std::vector<ArrivingLight>& out);

/// The lights of one scene. Coordinates are relative to the eye. Const calls from any thread.
class SceneLights
{
public:
    static constexpr int kMaxSkyRings = 64;

    /// @param skyRings 1..kMaxSkyRings: each half of the sky is `skyRings` rings of 2 skyRings directions
    void build(const OpaqueScene& scene, const glm::dvec3& eye, int skyRings);

    bool hasSun() const { return sun_.illuminance != glm::dvec3(0.0); }
    const ArrivingLight& sun() const { return sun_; }

    /// Lights of the scene's list, then those of glowing groups.
    size_t lampCount() const { return lamps_.size(); }
    /// Appends the light of one of them at a point: one direction of a point, a spot or a glowing group, many
    /// of a ball. A glowing group is as bright as if it were a point, but finite inside its extent, and
    /// nothing inside that extent blocks it.
    /// @param turn [1] 0..1, see appendCone()
    void appendLamp(size_t lamp, const glm::dvec3& point, double turn, std::vector<ArrivingLight>& out) const;

    /// How the light of a lamp changes along a ray.
    struct Course
    {
        double nearest;           ///< [m] ray parameter closest to the lamp
        double distance;          ///< [m] from the lamp there, but at least the lamp's extent
        std::vector<double> cuts; ///< [m] rising ray parameters where the light is not smooth
    };
    void course(size_t lamp, const TraceRay& ray, Course& out) const;

    /// @formula sky-quadrature
    ///          Directions and weights that integrate a function over the sphere, separately for each
    ///          hemisphere.
    ///
    /// symbol   unit   meaning
    ///   n             rings of a half
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
    /// @accuracy  with a shift of 1/2 the second order of the midpoint rule. A mean over k shifts of a
    /// lattice is
    ///   about that of k times as many directions
    /// @tests     tests/rendering/reference/render/test_scene_lights.cpp
    ///
    /// Appends the sky and, below the horizon, the light of the ground: 4 n^2 directions, black ones too.
    /// @param density n is so many times the rings given to build()
    void appendSky(const glm::dvec2& shift, int density, std::vector<ArrivingLight>& out) const;
    bool hasSky() const { return sky_ != glm::dvec3(0.0) || ground_ != glm::dvec3(0.0); }
    const glm::dvec3& sky() const { return sky_; }       ///< [cd/m2] above the horizon
    const glm::dvec3& ground() const { return ground_; } ///< [cd/m2] below it

private:
    struct Lamp
    {
        glm::dvec3 position, intensity;
        double radius;       ///< [m] of a ball, or the extent of a glowing group
        bool isGroup;        ///< a glowing group
        glm::dvec3 axis;     ///< unit, of a spot
        double inner, outer; ///< [1] cosines of a spot's angles; -2 and below: light in all directions
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
