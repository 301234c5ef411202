/// @file shape_def.h
/// Definition of the shape in which an emitter's particles are born.
#pragma once

#include <glm/vec3.hpp>

#include <cstdint>
#include <memory>

namespace fx::sim {

class SplinePath;
struct MeshSampler;
struct VolumeSampler;

/// Shapes of births, with the initial directions. Births are uniform in length, area or volume.
enum class ShapeKind : uint8_t
{
    Point,  ///< directions are uniform over the sphere
    Sphere, ///< in the ball of radius size.x, or on it; direction outwards
    Box, ///< in the box of half extents size, or on its faces; direction along the axis, from a face outwards
    Cone,   ///< on the disc of radius size.x, heads within `angle` of the axis; with a height, in the cone
            ///< that opens by `angle` above the disc, or on its side, and heads away from its tip
    Line,   ///< along the axis, size.x to both sides; direction away from the line
    Disc,   ///< on the disc of radius size.x, or on its rim; direction along the axis
    Torus,  ///< in the tube of radius `tube` around the circle of radius size.x, or on it; direction outwards
    Mesh,   ///< on the triangles; direction along their normals
    Spline, ///< along the curve; direction along its tangent
    Volume, ///< in the density of the grid; direction along the axis
};

/// All lengths are in the instance's local space.
struct ShapeDef
{
    ShapeKind kind = ShapeKind::Point;
    glm::vec3 position{0.0f};         ///< [m] center of the shape
    glm::vec3 size{0.0f};             ///< [m] see ShapeKind
    float angle = 0.0f;               ///< [rad] half angle of the cone, 0..pi; below pi/2 with a height
    glm::vec3 axis{0.0f, 1.0f, 0.0f}; ///< direction, of any length > 0; +Y turns onto it by the shortest way
    float inner = 0.0f;               ///< [1] 0..1 share of the radius that stays empty (sphere, cone's disc,
                                      ///< disc, the torus's tube)
    float height = 0.0f;              ///< [m] of the cone, >= 0
    float tube = 0.0f;                ///< [m] of the torus, 0..size.x
    bool onSurface = false;           ///< on the surface instead of inside

    // Required by the shape of the same name; relative to `position` and rotated by `axis`.
    std::shared_ptr<const MeshSampler> mesh;
    std::shared_ptr<const SplinePath> spline;
    std::shared_ptr<const VolumeSampler> volume;
};

} // namespace fx::sim
