/// @file moved_space.h
/// The space that particles stay in when their instance moves away from them.
///
/// @formula moved-births
/// Where a particle is born, and how fast, when the host has moved the instance in this step.
///
/// symbol   unit   meaning
///   H               space of the instance when the emitter began; particles keep to it
///   A, B            from the instance's space to H, at the begin and at the end of the step
///   t        1      share of the step at which the birth happens, 0..1
///   T        s      length of the step
///   p, v     m, m/s place and velocity of the birth as the shape gives them, in the instance's space
///   k        1      share of the instance's velocity that is inherited
/// @derivation
///   The host tells where the instance is, not how it got there; each of its points is taken to go straight
///       x = (1 - t) A p + t B p                                                             (1)
///   so that births of one step lie evenly along the way, and the point's own velocity is
///       w = (B p - A p) / T                                                                 (2)
///   Directions turn alike, without their own motion
///       u = (1 - t) A' v + t B' v + k w,    A' and B' without their offsets                 (3)
///   A, B are rigid motions with the change of scale; while nothing has moved they are left out, so that
///   nothing is rounded.
/// @source    elementary
/// @deviation a turn within a step takes chords for arcs: (3) is shorter by 1 - cos(half the angle)
/// @valid     any placements; T > 0
/// @accuracy  float rounding of the distance from where the emitter began
/// @tests     tests/simulation/particles/events/test_moved_emitters.cpp
#pragma once

#include "foundation/math/geometry.h"
#include "simulation/state/state_reader.h"
#include "simulation/state/state_writer.h"

namespace fx::sim {

/// Linear interpolation by `share`; the bits depend on the arguments only.
base::Placement between(const base::Placement& from, const base::Placement& to, float share);

class MovedSpace
{
public:
    /// The emitter begins here.
    void begin(const base::Placement& placement);
    /// A step begins, at whose end the instance has gone `share` of the way to `placement`.
    void moveTo(const base::Placement& placement, float share = 1.0f);
    /// Sets the placement without a path to it.
    void jumpTo(const base::Placement& placement);
    /// True when the placement equals that at the end of the last step.
    bool stands(const base::Placement& placement) const;

    const base::Placement& home() const { return home_; }
    /// (1) to (3) of a birth that the clock gave.
    void carry(float share, float seconds, float inherit, glm::vec3& ioPosition, glm::vec3& ioVelocity) const;
    /// A point at the begin of the step. (1) at t = 0
    glm::vec3 placed(const glm::vec3& point) const;
    /// A vector at the end of the step. (3) at t = 1
    glm::vec3 turned(const glm::vec3& vector) const;
    /// From the world's axes to those of H.
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
    base::Placement last_; ///< end of the last step
    Pose begin_;           ///< A
    Pose end_;             ///< B
};

} // namespace fx::sim
