/// @file moved_space.h
/// Space in which particles stay when their instance moves.
///
/// @formula moved-births
/// Position and velocity of a birth when the host has moved the instance in this step.
///
/// symbol   unit   meaning
///   H               space of the instance at the start of the emitter; particles stay in it
///   A, B            transforms from the instance's space to H, at the begin and at the end of the step
///   t        1      share of the step at which the birth happens, 0..1
///   T        s      length of the step
///   p, v     m, m/s position and velocity of the birth from the shape, in the instance's space
///   k        1      share of the instance's velocity that is inherited
/// @derivation
///   The host sets placements without paths between them. Each point is assumed to move on a straight line
///       x = (1 - t) A p + t B p                                                             (1)
///   so births of one step are evenly spaced along the path, and the velocity of the point is
///       w = (B p - A p) / T                                                                 (2)
///   Directions are interpolated in the same way, without their own motion
///       u = (1 - t) A' v + t B' v + k w,    A' and B' without their offsets                 (3)
///   A and B consist of rigid motion and scale. They are not applied if nothing has moved, to avoid rounding.
/// @source    elementary
/// @deviation a rotation within a step uses chords instead of arcs: (3) is shorter by 1 - cos(half the angle)
/// @valid     any placements; T > 0
/// @accuracy  float rounding of the distance from the start of the emitter
/// @tests     tests/simulation/particles/events/test_moved_emitters.cpp
#pragma once

#include "foundation/math/geometry.h"
#include "simulation/state/state_reader.h"
#include "simulation/state/state_writer.h"

namespace fx::sim {

/// Linear interpolation of placements. @param share [1] weight of `to`
base::Placement between(const base::Placement& from, const base::Placement& to, float share);

class MovedSpace
{
public:
    /// Sets the placement at the start of the emitter.
    void begin(const base::Placement& placement);
    /// Begins a step. During the step, the instance moves by the fraction `share` of the way to `placement`.
    void moveTo(const base::Placement& placement, float share = 1.0f);
    /// Sets the placement without motion from the last placement.
    void jumpTo(const base::Placement& placement);
    /// True if `placement` equals the placement at the end of the last step.
    bool stands(const base::Placement& placement) const;

    const base::Placement& home() const { return home_; }
    /// Transforms position and velocity of a birth by rate or burst to the space H, by equations (1) to (3).
    void carry(float share, float seconds, float inherit, glm::vec3& ioPosition, glm::vec3& ioVelocity) const;
    /// Transforms a point from the instance's space to the space H, by equation (1) at the beginning of the
    /// step.
    glm::vec3 placed(const glm::vec3& point) const;
    /// Transforms a vector from the instance's space to the space H, by equation (3) at the end of the step.
    glm::vec3 turned(const glm::vec3& vector) const;
    /// Rotates a vector from the axes of the world to the axes of the space H.
    glm::vec3 fromWorld(const glm::vec3& vector) const { return glm::conjugate(home_.rotation) * vector; }

    void save(StateWriter& writer) const;
    void restore(StateReader& reader);

private:
    struct Pose
    {
        glm::vec3 offset{0.0f};
        glm::quat rotation{1.0f, 0.0f, 0.0f, 0.0f};
        float scale = 1.0f;
        bool isHome = true;
    };
    Pose poseOf(const base::Placement& placement) const;
    static glm::vec3 turnedBy(const Pose& pose, const glm::vec3& v);

    base::Placement home_;
    base::Placement last_; ///< placement at the end of the last step
    Pose begin_;           ///< transform to H at the beginning of the step, symbol A of the formula
    Pose end_;             ///< transform to H at the end of the step, symbol B of the formula
};

} // namespace fx::sim
