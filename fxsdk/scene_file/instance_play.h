/// @file instance_play.h
/// Changes of one effect of a scene over time. The changes correspond to API calls of a host.
///
/// All times are scene times [s], except TimeJump::to.
#pragma once

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace fx::scene_file {

/// Placement of the effect at one time.
struct InstanceKey
{
    double time = 0;        ///< [s] later than the time of the previous key
    glm::dvec3 position{0}; ///< [m] world; used only if InstancePlay::moves
    /// [degree] rotation about x, then y, then z; used only if InstancePlay::turns
    glm::dvec3 rotationDegrees{0};
};

/// A value that is valid from `time` on.
struct TimedValue
{
    double time = 0; ///< [s] later than the time of the previous value
    double value = 0;
};

/// An event of the host.
struct Trigger
{
    double time = 0; ///< [s] not before the start of the instance or the previous trigger
    std::string name;
    uint32_t count = 1;
};

/// A jump in the local time of the effect.
struct TimeJump
{
    double time = 0; ///< [s] not before the start of the instance or the previous jump
    double to = 0;   ///< [s] local time after the jump
};

struct InstancePlay
{
    std::vector<InstanceKey> keys;
    bool moves = false;            ///< true: the keys have positions
    bool turns = false;            ///< true: the keys have rotations
    std::vector<TimedValue> speed; ///< [1] speed of the local time; 1 before the first value
    /// [1] 1: the effect emits particles, 0: no emission; 1 before the first value.
    std::vector<TimedValue> emitting;
    std::vector<Trigger> triggers;
    std::vector<TimeJump> jumps;

    bool isEmpty() const
    {
        return keys.empty() && speed.empty() && emitting.empty() && triggers.empty() && jumps.empty();
    }
};

/// Returns the last value whose time is at most `time`, or `before` if there is no such value.
double valueAt(const std::vector<TimedValue>& values, double time, double before);

} // namespace fx::scene_file
