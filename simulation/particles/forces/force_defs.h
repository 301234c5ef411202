/// @file force_defs.h
/// Definitions of forces on particles, other than gravity, drag, wind and turbulence. All lengths are in the
/// instance's local space.
#pragma once

#include "simulation/collision/distance_field.h"
#include "simulation/particles/fields/field_grid.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <memory>

namespace fx::sim {

/// Wind whose speed varies in time (gusts).
struct GustDef
{
    glm::vec3 strength{0.0f}; ///< [m/s] maximum deviation of each component of the wind
    float period = 1.0f;      ///< [s] time between two changes of the deviation, > 0
};

/// Air that rotates about an axis as a Kaufmann (Scully) vortex: the speed is largest at `radius`. The speed
/// is proportional to the distance r from the axis far inside, and to 1 / r far outside.
struct VortexDef
{
    glm::vec3 position{0.0f}; ///< [m] position of a point on the axis
    /// direction of the axis, of any length > 0; the rotation about the axis is right-handed
    glm::vec3 axis{0.0f, 1.0f, 0.0f};
    float radius = 1.0f; ///< [m] > 0
    float speed = 0.0f;  ///< [m/s] speed of the air at `radius`
    float lift = 0.0f;   ///< [m/s] speed of the air along the axis, at the axis
    float pull = 0.0f;   ///< [m/s] speed of the air towards the axis, at `radius`
    /// [1] Fraction of the centripetal acceleration that is applied, 0..1. With 1, a particle stays on its
    /// circle.
    float hold = 0.0f;
};

/// Dependence of an attraction on distance r.
enum class Falloff : uint8_t
{
    Spring,        ///< proportional to r
    Constant,      ///< independent of r
    Inverse,       ///< proportional to 1 / r
    InverseSquare, ///< proportional to 1 / r^2
};

struct AttractorDef
{
    glm::vec3 position{0.0f}; ///< [m]
    float strength = 0.0f;    ///< [m/s2] acceleration at the distance `radius`; negative values repel
    float radius = 1.0f;      ///< [m] > 0
    Falloff falloff = Falloff::InverseSquare;
    float softening = 0.0f;  ///< [m] length that keeps the acceleration finite at the center, >= 0
    float reach = 0.0f;      ///< [m] distance beyond which the force is 0; 0: no limit
    float killRadius = 0.0f; ///< [m] distance within which particles die; 0: no particles die
};

struct VectorFieldDef
{
    std::shared_ptr<const FieldGrid> grid; ///< grid with three channels
    glm::vec3 position{0.0f};              ///< [m] position of the origin of the grid
    float scale = 1.0f;                    ///< [1] factor on the lengths of the grid, > 0
    float strength = 1.0f;                 ///< [1] factor on the vectors
    /// true: vectors are accelerations [m/s2]; false: velocities of the air [m/s]
    bool isAcceleration = false;
};

/// Surface that a distance refers to.
enum class SurfaceKind : uint8_t
{
    Sphere,
    Box,
    Mesh,
};

/// Attraction of particles to a surface by a damped spring.
struct ConformDef
{
    SurfaceKind kind = SurfaceKind::Sphere;
    glm::vec3 position{0.0f};                   ///< [m] position of the center, or of the origin of the mesh
    glm::vec3 size{1.0f};                       ///< [m] radius (component x) or half extents
    std::shared_ptr<const DistanceField> field; ///< distance field of the mesh
    float distance = 0.0f;  ///< [m] distance from the surface at which the spring is at rest; negative inside
    float stiffness = 0.0f; ///< [1/s2] >= 0
    float damping = 0.0f;   ///< [1/s] damping rate of the velocity along the normal, >= 0
    float reach = 0.0f;     ///< [m] distance beyond which the force is 0; 0: no limit
};

} // namespace fx::sim
