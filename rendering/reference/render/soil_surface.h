/// @file soil_surface.h
/// Relief and color of soil (formula soil-texture), averaged over the image of a pixel on the ground. The
/// stage evaluates the same sums in shaders/stage/soil_surface.glsl.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace fx::render {

struct SoilSurface
{
    glm::dvec3 share{1.0}; ///< [1] factor of the albedo, mean 1
    glm::dvec2 slope{0.0}; ///< [1] slope of the height along x and z

    /// Unit normal of the relief on a surface with the unit normal `n`.
    glm::dvec3 normal(const glm::dvec3& n) const;
};

/// @param place [m] horizontal position in the coordinates of the mesh
/// @param along [m] long axis of the pixel's image on the ground
/// @param width [m] length of its short axis, >= 0
SoilSurface soilAt(const glm::dvec2& place, const glm::dvec2& along, double width);

/// The same for a ray that meets level ground.
/// @param direction unit vector of the ray
/// @param width [m] width of a pixel at the place, across the ray
SoilSurface soilSeen(const glm::dvec2& place, const glm::dvec3& direction, double width);

} // namespace fx::render
