/// @file collider.h
/// The host's geometry as the particles of one instance meet it.
///
/// @formula field-sweep
/// First place of a straight way at which a point meets the surface of a distance field.
///
/// symbol   unit   meaning
///   p(x)     m      place on the way after x meters
///   l        m      length of the way
///   d        m      distance sampled at p(x)
///   h        m      edge of a cell
///   e        m      most by which d may be too large, 0.866 h
///   q        m      shortest stride, h / 4
/// @derivation
///   No surface is nearer to p(x) than d - e, so the way is free for that far; the stride is
///       x <- min(x + max(d - e, q), l)                                                        (1)
///   The way ends where d <= 0 is met for the first time; between there and the place before, x is halved
///   six times towards the last place with d > 0                                                (2)
///   A way that begins with d <= 0 is not looked at; field-bounce moves its beginning out first  (3)
/// @source    [HAR96] section 2 (sphere tracing); (2) is bisection
/// @deviation a least stride, so that the way along a surface takes a bounded number of samples
/// @valid     any finite way; one longer than 4096 strides ends there
/// @accuracy  never skips more than q of matter, and matter is at least h / 2 thick; the place
///            found is within q / 64 of the surface of the field
/// @tests     tests/simulation/collision/test_collider.cpp
///
/// @formula field-bounce
/// A particle's place and velocity after it met the field.
///
/// symbol   unit   meaning
///   x, v     m, m/s place and velocity
///   n        1      unit vector away from the surface
///   d        m      distance at x
///   c        m      distance that the particle keeps
///   e        1      restitution, 0..1
///   f        1      friction: tangential velocity lost, 0..1
/// @derivation
///   approach a = v.n; where a < 0
///       v' = (1 - f) (v - a n) - e a n                                                        (1)
///   pushed out, up to four times, since at an edge n changes on the way
///       x' = x + (c - d) n                                                                    (2)
///   A way that begins inside of matter begins instead where (2) leads                          (3)
///   What is left of a way after it met a surface goes on with the new velocity, or, for what has no time of
///   its own, slides on: r' = r - min(r.n, 0) n                                                  (4)
///   What is still inside at the end goes back to the beginning of its way                      (5)
/// @source    elementary
/// @deviation contact at c acts when the way ends, not where it first comes as near as c
/// @valid     c >= 0; n = 0 moves nothing
/// @accuracy  a way that begins outside ends outside; speed never grows
/// @tests     tests/simulation/collision/test_collider.cpp
#pragma once

#include "foundation/math/geometry.h"
#include "simulation/collision/distance_field.h"

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

namespace fx::sim {

/// How a surface answers.
struct SurfaceResponse
{
    float clearance = 0.0f;   ///< [m] local, that centers keep
    float restitution = 0.0f; ///< [1] 0..1
    float friction = 0.0f;    ///< [1] 0..1
};

/// A field in the space of an instance. Any thread; allocates nothing.
class Collider
{
public:
    Collider(const DistanceField& field, const base::Placement& placement);

    const DistanceField& field() const { return field_; }
    /// [m] local
    DistanceField::Sample sample(const glm::vec3& position) const;

    struct Hit
    {
        bool found;
        float share;      ///< [1] free share of the path, 1 without a contact
        glm::vec3 normal; ///< of the surface that ends it
    };
    /// The free part of the way of a center from `from` to `to`.
    Hit sweep(const glm::vec3& from, const glm::vec3& to) const;

    /// Corrects the end of a way from `from`: it slides along the surfaces that it meets; the velocity is
    /// reflected, and the end keeps the clearance. @return true when something was met
    bool settle(const glm::vec3& from, glm::vec3& ioPosition, glm::vec3& ioVelocity,
                const SurfaceResponse& response) const;

    /// As the other overload, but continues with the new velocity for the rest of `seconds` after a contact.
    bool bounce(const glm::vec3& from, glm::vec3& ioPosition, glm::vec3& ioVelocity,
                const SurfaceResponse& response, float seconds) const;

private:
    glm::vec3 toField(const glm::vec3& local) const { return offset_ + rotation_ * (scale_ * local); }
    glm::vec3 outside(const glm::vec3& position) const;
    bool pushOut(const glm::vec3& from, glm::vec3& ioPosition, glm::vec3& ioVelocity,
                 const SurfaceResponse& response) const;

    const DistanceField& field_;
    glm::vec3 offset_; ///< [m] of the instance's origin in the field
    glm::quat rotation_;
    float scale_;
};

} // namespace fx::sim
