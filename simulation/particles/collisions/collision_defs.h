/// @file collision_defs.h
/// What stands in the way of particles, and what happens to those that meet it. Particles are points. All
/// lengths in the instance's local space.
#pragma once

#include "simulation/collision/distance_field.h"
#include "simulation/particles/fields/field_grid.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <memory>

namespace fx::sim {

enum class ObstacleKind : uint8_t
{
    Plane,       ///< through `position` with the normal `axis`; matter below it
    Sphere,      ///< of radius size.x
    Box,         ///< of half extents size, its +Y along `axis`
    Mesh,        ///< `field`
    HeightField, ///< `heights` above the plane through `position`, which is not turned
    Ground,      ///< the instance's ground plane, where it has one
    Scene,       ///< the host's geometry, where it gave one
    Hook,        ///< StepContext::contactHook, where the host set one
    Depth,       ///< what the depth texture of a view shows: on the GPU alone, elsewhere nothing is met
};

enum class ContactResponse : uint8_t
{
    Bounce, ///< reflected
    Kill,   ///< dies where it touches
    Stick,  ///< stays where it touches
};

struct CollisionDef
{
    ObstacleKind kind = ObstacleKind::Plane;
    glm::vec3 position{0.0f};         ///< [m] center, or of the mesh's or grid's own origin
    glm::vec3 axis{0.0f, 1.0f, 0.0f}; ///< of any length > 0
    glm::vec3 size{1.0f};             ///< [m]
    bool isHollow = false;            ///< sphere and box: particles are kept inside
    float margin = 0.0f;              ///< [m] kept from planes, spheres, boxes, heights and what is seen
    float thickness = 0.5f;           ///< [m] Depth: that what is seen is taken to have, along the ray
    std::shared_ptr<const DistanceField> field; ///< of the mesh
    std::shared_ptr<const FieldGrid> heights;   ///< [m] one channel, one node along y

    ContactResponse response = ContactResponse::Bounce;
    float restitution = 0.5f; ///< [1] 0..1 share of the normal speed that is kept
    float friction = 0.0f;    ///< [1] 0..1 share of the tangential speed that is lost
};

} // namespace fx::sim
