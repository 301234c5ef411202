/// @file surface_light.h
/// Light on the scene's triangles, by shadow rays through media and past other triangles.
#pragma once

#include "rendering/reference/render/scene_lights.h"
#include "rendering/reference/render/shadow_ray.h"

#include <vector>

namespace fx::render {

/// @formula surface-illuminance
/// Illuminance of a surface by all lights of a scene.
///
/// symbol     unit    meaning
///   n                normal; c_l = max(0, n . direction to light l)
///   E_l      lx      illuminance of light l with nothing in its way, its directions apart
///   T_l      1       transmittance of the medium towards it, 0 behind a triangle
///   L_h      cd/m2   luminance of the upper half of the sky, or of the ground in the lower half
///   F_h      1       share of half h in what the surface faces, (1 + n_y) / 2 or (1 - n_y) / 2
///   w_j      sr      weight of direction j of half h
/// @derivation
///   E = sum over l of E_l c_l T_l + sum over h of pi L_h F_h M_h                                   (1)
///   M_h = sum of w_j c_j T_j / sum of w_j c_j over the directions j of half h                      (2)
/// @source    textbook
/// @deviation (2) is divided by its own sum of weights, so that an open sky is exact whatever the number of
///   directions
/// @valid     light that other surfaces reflect is left out
/// @accuracy  exact for points, spots and the sun; balls by cone-quadrature, sky by sky-quadrature with twice
/// the
///   rings
/// @tests     tests/rendering/reference/render/test_surface_light.cpp
///
/// One for each thread.
class SurfaceLight
{
public:
    /// @param medium, opaque, lights must outlive this
    SurfaceLight(const MediumView& medium, const OpaqueView& opaque, const SceneLights& lights)
        : shadow_(medium, opaque), lights_(lights)
    {}

    /// [lx] @param position a little above the surface  @param normal unit, towards the side that is seen
    glm::dvec3 at(const glm::dvec3& position, const glm::dvec3& normal);

private:
    glm::dvec3 skyAt(const glm::dvec3& position, const glm::dvec3& normal);

    ShadowRay shadow_;
    const SceneLights& lights_;
    std::vector<ArrivingLight> arriving_;
};

} // namespace fx::render
