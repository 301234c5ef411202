/// @file collision_defs.h
/// Obstacles of particles, and the response to contacts. Particles are points. All lengths are in the
/// instance's local space.
#pragma once

#include "simulation/collision/distance_field.h"
#include "simulation/particles/fields/field_grid.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <memory>

namespace fx::sim {

enum class ObstacleKind : uint8_t
{
    Plane,       ///< plane through `position` with the normal `axis`; matter is below the plane
    Sphere,      ///< sphere of radius size.x
    Box,         ///< box with the half extents `size`, whose +Y points along `axis`
    Mesh,        ///< triangle mesh, given by its distance field `field`
    HeightField, ///< height field `heights` above the plane through `position`, without rotation
    Ground,      ///< the instance's ground plane, if enabled
    Scene,       ///< the host's geometry, if set
    Hook,        ///< the host's contact callback StepContext::contactHook, if set
    Depth,       ///< surfaces in the depth texture of a view; only the GPU computes these contacts
};

enum class ContactResponse : uint8_t
{
    Bounce, ///< the particle is reflected
    Kill,   ///< the particle dies at the contact
    Stick,  ///< the particle stays at the contact
};

struct CollisionDef
{
    ObstacleKind kind = ObstacleKind::Plane;
    glm::vec3 position{0.0f};         ///< [m] position of the center, or of the origin of a mesh or grid
    glm::vec3 axis{0.0f, 1.0f, 0.0f}; ///< direction of the axis, of any length > 0
    glm::vec3 size{1.0f};             ///< [m]
    bool isHollow = false;            ///< for spheres and boxes: true keeps particles inside
    float margin = 0.0f; ///< [m] distance that particles keep from planes, spheres, boxes, height fields and
                         ///< depth surfaces
    float thickness = 0.5f; ///< [m] for ObstacleKind::Depth: assumed thickness of surfaces along the ray
    std::shared_ptr<const DistanceField> field; ///< distance field of the mesh
    std::shared_ptr<const FieldGrid> heights;   ///< [m] heights: one channel, one node along y

    ContactResponse response = ContactResponse::Bounce;
    float restitution = 0.5f; ///< [1] 0..1 fraction of the normal speed after the contact
    float friction = 0.0f;    ///< [1] 0..1 fraction of the tangential speed that is lost
};

} // namespace fx::sim
