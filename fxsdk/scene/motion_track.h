/// @file motion_track.h
/// Path of an instance between poses that the host states with their times.
///
/// @formula motion-track
/// Placement at a time between two poses.
///
/// symbol    unit   meaning
///   a, b    s      times of the two poses, a < b
///   u       1      share of the way in time, (t - a) / (b - a), 0..1
///   P, Q    m      positions at a and b
///   v, w    m/s    velocities at a and b
///   R, S    1      rotations at a and b
/// @derivation
///   Without velocities the path is straight, at constant speed:
///       x = P + u (Q - P)                                                                   (1)
///   With velocities it is the cubic in u with the values P, Q and the slopes (b - a) v, (b - a) w at its
///   ends. In terms of the straight path, with d = Q - P, m = (b - a) v - d and n = (b - a) w - d,
///       x = P + u d + u (1 - u) ((1 - u) m - u n)                                           (2)
///   Rotations turn at a constant rate about a fixed axis, the shorter way:
///       slerp(R, S, u)                                                                      (3)
/// @source    elementary; (2) is the cubic Hermite interpolation
/// @deviation none
/// @valid     finite poses; a rotation of less than half a turn between two poses
/// @accuracy  (1) is exact to rounding for uniform motion; on a circle of radius r that turns by an angle h
///            between two poses, (2) is within r h^4 / 384 of it, to leading order
/// @tests     tests/api/test_motion.cpp
#pragma once

#include "foundation/math/geometry.h"
#include "foundation/time/ticks.h"
#include "simulation/state/state_reader.h"
#include "simulation/state/state_writer.h"

#include <array>
#include <cstdint>

namespace fx::scene {

/// A placement at a time.
struct MotionPose
{
    base::Ticks tick = 0; ///< scene time
    base::Placement placement;
    glm::vec3 velocity{0.0f}; ///< [m/s] world
    bool hasVelocity = false; ///< false: the paths from and to this pose are straight
};

/// The last poses of an instance.
class MotionTrack
{
public:
    /// The pose from which the instance comes, and FX_MOTION_POSES after it.
    static constexpr uint32_t kMaxPoses = 9;

    /// Adds a pose, which replaces all poses at its time and after it. If kMaxPoses are before it, the oldest
    /// of them is discarded.
    void add(const MotionPose& pose);
    /// True if add() of a pose at `tick` would discard one.
    bool isFull(base::Ticks tick) const { return count_ == kMaxPoses && newest() < tick; }
    /// Time of the pose that becomes the oldest one if add() discards one. Must be full.
    base::Ticks second() const { return poses_[1].tick; }
    /// Removes the second pose: the path from the oldest pose to the third is coarser. Must be full.
    void removeSecond();
    void clear() { count_ = 0; }
    bool empty() const { return count_ == 0; }
    base::Ticks newest() const { return poses_[count_ - 1].tick; } ///< must not be empty
    /// Placement at a time. Before the first pose and after the last pose, the placement of this pose. Must
    /// not be empty.
    base::Placement at(base::Ticks tick) const;

    void save(sim::StateWriter& writer) const;
    void restore(sim::StateReader& reader);

private:
    std::array<MotionPose, kMaxPoses> poses_; ///< the first count_ are valid, ascending by tick
    uint32_t count_ = 0;
};

} // namespace fx::scene
