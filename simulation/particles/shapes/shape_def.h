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

/// Shapes of births: positions and initial directions. Births are uniform in length, area or volume.
enum class ShapeKind : uint8_t
{
    Point,  ///< births at a point; directions are uniform over the sphere
    Sphere, ///< births in the ball of radius size.x, or on the surface of the ball; direction outwards
    /// births in the box with the half extents `size`, with the direction of the axis. On the surface, the
    /// direction is outwards
    Box,
    /// births on the disc of radius size.x, with directions within `angle` of the axis. With a height: births
    /// in the cone that widens by `angle` above the disc, or on its lateral surface. Directions are away from
    /// the tip of the cone
    Cone,
    Line, ///< births on the line along the axis, from -size.x to size.x; direction away from the line
    Disc, ///< births on the disc of radius size.x, or on the rim of the disc; direction along the axis
    /// births in the tube of radius `tube` around the circle of radius size.x, or on the surface of the tube;
    /// direction outwards
    Torus,
    Mesh,   ///< births on the triangles of the mesh; direction along the normals
    Spline, ///< births on the curve; direction along the tangent
    Volume, ///< births distributed by the density of the grid; direction along the axis
};

/// Definition of the shape of births. All lengths are in the instance's local space.
struct ShapeDef
{
    ShapeKind kind = ShapeKind::Point;
    glm::vec3 position{0.0f}; ///< [m] center of the shape
    glm::vec3 size{0.0f};     ///< [m] see ShapeKind
    float angle = 0.0f;       ///< [rad] half angle of the cone, 0..pi; below pi/2 if the cone has a height
    /// Direction of the axis, of any length > 0. The shape is rotated by the shortest rotation from +Y to the
    /// axis.
    glm::vec3 axis{0.0f, 1.0f, 0.0f};
    /// [1] Fraction of the radius without births, 0..1. The fraction applies to sphere, disc of the cone,
    /// disc and tube of the torus.
    float inner = 0.0f;
    float height = 0.0f;    ///< [m] height of the cone, >= 0
    float tube = 0.0f;      ///< [m] radius of the tube of the torus, 0..size.x
    bool onSurface = false; ///< true: births are on the surface; false: births are inside

    // Each member is required by the shape of the same name. Its data are relative to `position` and rotated
    // by `axis`.
    std::shared_ptr<const MeshSampler> mesh;
    std::shared_ptr<const SplinePath> spline;
    std::shared_ptr<const VolumeSampler> volume;
};

} // namespace fx::sim
