/// @file collider.h
/// The host's collision geometry in the space of one instance.
///
/// @formula field-sweep
/// First contact of a moving point with the surface of a distance field, on a straight path.
///
/// symbol   unit   meaning
///   p(x)     m      position on the path after x meters
///   l        m      length of the path
///   d        m      distance sampled at p(x)
///   h        m      edge of a cell
///   e        m      upper bound of the amount by which d is too large, 0.866 h
///   q        m      shortest stride, h / 4
/// @derivation
///   No surface is nearer to p(x) than d - e, so the path is free over that length. The step is
///       x <- min(x + max(d - e, q), l)                                                        (1)
///   The path ends at the first sample with d <= 0. Six bisections between it and the last sample with d > 0
///   refine the contact; the result is the last position with d > 0                              (2)
///   A path that begins with d <= 0 is not searched; field-bounce first moves its beginning out  (3)
/// @source    [HAR96] section 2 (sphere tracing); (2) is bisection
/// @deviation a minimum stride, so that a path along a surface takes a bounded number of samples
/// @valid     any finite path; a path longer than 4096 strides ends there
/// @accuracy  never skips more than q of matter, and matter is at least h / 2 thick; the contact is within
///            q / 64 of the surface of the field
/// @tests     tests/simulation/collision/test_collider.cpp
///
/// @formula field-bounce
/// Position and velocity of a particle after a contact with the field.
///
/// symbol   unit   meaning
///   x, v     m, m/s place and velocity
///   n        1      unit vector away from the surface
///   d        m      distance at x
///   c        m      distance that the particle keeps from the surface
///   e        1      restitution, 0..1
///   f        1      friction: tangential velocity lost, 0..1
/// @derivation
///   approach a = v.n; if a < 0
///       v' = (1 - f) (v - a n) - e a n                                                        (1)
///   the position is pushed out, up to four times, because n changes near edges
///       x' = x + (c - d) n                                                                    (2)
///   If a path begins inside of matter, (2) is applied to its beginning                          (3)
///   After a contact, the rest of the path continues with the new velocity. If no time is given for the rest,
///   it slides: r' = r - min(r.n, 0) n                                                              (4)
///   A position that is still inside of matter at the end is set back to the beginning of its path (5)
/// @source    elementary
/// @deviation the distance c is enforced at the end of the path only, not at the first approach to c
/// @valid     c >= 0; n = 0 moves nothing
/// @accuracy  a path that begins outside ends outside; speed never grows
/// @tests     tests/simulation/collision/test_collider.cpp
#pragma once

#include "foundation/math/geometry.h"
#include "simulation/collision/distance_field.h"

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

namespace fx::sim {

/// Response of a surface to contacts.
struct SurfaceResponse
{
    float clearance = 0.0f;   ///< [m] smallest local distance of particle centers from the surface
    float restitution = 0.0f; ///< [1] 0..1
    float friction = 0.0f;    ///< [1] 0..1
};

/// A signed distance field in the local space of an instance. Functions allocate no memory. [any thread]
class Collider
{
public:
    Collider(const DistanceField& field, const base::Placement& placement);

    const DistanceField& field() const { return field_; }
    /// Distance and normal at a position [m] in the local space.
    DistanceField::Sample sample(const glm::vec3& position) const;

    struct Hit
    {
        bool found;
        float share; ///< [1] length of the path before the contact divided by the whole length; 1 without a
                     ///< contact
        glm::vec3 normal; ///< normal of the surface at the contact
    };
    /// Finds the first contact of a particle center on the path from `from` to `to`.
    Hit sweep(const glm::vec3& from, const glm::vec3& to) const;

    /// Corrects the end of a path from `from` with sliding. The path slides along surfaces, the velocity is
    /// reflected, and the end has at least the clearance from surfaces. @return true if there was a contact
    bool settle(const glm::vec3& from, glm::vec3& ioPosition, glm::vec3& ioVelocity,
                const SurfaceResponse& response) const;

    /// Corrects the end of a path from `from` without sliding. After a contact, the particle moves with the
    /// reflected velocity for the remaining part of `seconds`. @return true if there was a contact
    bool bounce(const glm::vec3& from, glm::vec3& ioPosition, glm::vec3& ioVelocity,
                const SurfaceResponse& response, float seconds) const;

private:
    glm::vec3 toField(const glm::vec3& local) const { return offset_ + rotation_ * (scale_ * local); }
    glm::vec3 outside(const glm::vec3& position) const;
    bool pushOut(const glm::vec3& from, glm::vec3& ioPosition, glm::vec3& ioVelocity,
                 const SurfaceResponse& response) const;

    const DistanceField& field_;
    glm::vec3 offset_; ///< [m] position of the instance's origin in the field
    glm::quat rotation_;
    float scale_;
};

} // namespace fx::sim
