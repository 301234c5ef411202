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
    glm::vec3 strength{0.0f}; ///< [m/s] maximum change of each component
    float period = 1.0f;      ///< [s] time between two changes, > 0
};

/// Air that rotates about an axis as a Kaufmann (Scully) vortex: its speed is largest at `radius`,
/// proportional to r far inside and to 1 / r far outside.
struct VortexDef
{
    glm::vec3 position{0.0f};         ///< [m] a point of the axis
    glm::vec3 axis{0.0f, 1.0f, 0.0f}; ///< direction, of any length > 0; right-handed rotation
    float radius = 1.0f;              ///< [m] > 0
    float speed = 0.0f;               ///< [m/s] speed of the air at `radius`
    float lift = 0.0f;                ///< [m/s] along the axis, at the axis
    float pull = 0.0f;                ///< [m/s] towards the axis, at `radius`
    float hold = 0.0f; ///< [1] 0..1 share of the acceleration that keeps a particle on its circle
};

/// Dependence of an attraction on distance r.
enum class Falloff : uint8_t
{
    Spring,        ///< grows as r
    Constant,      ///< independent of r
    Inverse,       ///< falls as 1 / r
    InverseSquare, ///< falls as 1 / r^2
};

struct AttractorDef
{
    glm::vec3 position{0.0f}; ///< [m]
    float strength = 0.0f;    ///< [m/s2] at the distance `radius`; negative repels
    float radius = 1.0f;      ///< [m] > 0
    Falloff falloff = Falloff::InverseSquare;
    float softening = 0.0f;  ///< [m] >= 0, keeps the acceleration finite at the center
    float reach = 0.0f;      ///< [m] distance beyond which the force is 0; 0: no limit
    float killRadius = 0.0f; ///< [m] particles within this distance die; 0: none
};

struct VectorFieldDef
{
    std::shared_ptr<const FieldGrid> grid; ///< grid with three channels
    glm::vec3 position{0.0f};              ///< [m] origin of the grid
    float scale = 1.0f;                    ///< [1] > 0, of the grid's lengths
    float strength = 1.0f;                 ///< [1] multiplies the vectors
    bool isAcceleration = false;           ///< vectors are [m/s2]; otherwise velocities of the air [m/s]
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
    glm::vec3 position{0.0f};                   ///< [m] center, or origin of the mesh
    glm::vec3 size{1.0f};                       ///< [m] radius (x) or half extents
    std::shared_ptr<const DistanceField> field; ///< distance field of the mesh
    float distance = 0.0f;                      ///< [m] rest distance from the surface, negative inside
    float stiffness = 0.0f;                     ///< [1/s2] >= 0
    float damping = 0.0f;                       ///< [1/s] >= 0, of the velocity along the normal
    float reach = 0.0f;                         ///< [m] distance beyond which the force is 0; 0: no limit
};

} // namespace fx::sim
