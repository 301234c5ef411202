/// @file surface_light.h
/// Computes the illuminance of the triangles of a scene, with shadows of media and of other triangles.
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
///   E_l      lx      illuminance of light l without attenuation; each direction of a light counts separately
///   T_l      1       transmittance of the medium towards it, 0 if a triangle blocks it
///   L_h      cd/m2   luminance of hemisphere h: of the sky above, of the ground below the horizon
///   F_h      1       form factor of hemisphere h for the surface, (1 + n_y) / 2 or (1 - n_y) / 2
///   w_j      sr      weight of direction j of hemisphere h
/// @derivation
///   E = sum over l of E_l c_l T_l + sum over h of pi L_h F_h M_h                                   (1)
///   M_h = sum of w_j c_j T_j / sum of w_j c_j over the directions j of hemisphere h                (2)
/// @source    textbook
/// @deviation (2) is divided by its sum of weights, so that an unoccluded sky is exact for any number of
///            directions
/// @valid     without light that other surfaces reflect
/// @accuracy  exact for points, spots and the sun; balls by cone-quadrature, sky by sky-quadrature with
///            twice the rings
/// @tests     tests/rendering/reference/render/test_surface_light.cpp
///
/// Each thread needs its own object.
class SurfaceLight
{
public:
    /// @param medium, opaque, lights objects that must outlive this one
    SurfaceLight(const MediumView& medium, const OpaqueView& opaque, const SceneLights& lights)
        : shadow_(medium, opaque), lights_(lights)
    {}

    /// [lx] Illuminance by all lights.
    /// @param position point slightly above the surface
    /// @param normal unit normal on the visible side
    glm::dvec3 at(const glm::dvec3& position, const glm::dvec3& normal);

private:
    glm::dvec3 skyAt(const glm::dvec3& position, const glm::dvec3& normal);

    ShadowRay shadow_;
    const SceneLights& lights_;
    std::vector<ArrivingLight> arriving_;
};

} // namespace fx::render
