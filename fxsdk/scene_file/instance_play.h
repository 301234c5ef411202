/// @file instance_play.h
/// Changes of one effect of a scene over time, corresponding to API calls of a host.
///
/// All times are those of the scene [s], not of the effect.
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
    double time = 0;        ///< [s] later than that of the previous key
    glm::dvec3 position{0}; ///< [m] world; used only if InstancePlay::moves
    /// [degree] rotation about x, then y, then z; used only if InstancePlay::turns
    glm::dvec3 rotationDegrees{0};
};

/// A value that is valid from a time on.
struct TimedValue
{
    double time = 0; ///< [s] later than that of the previous value
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
    bool moves = false;               ///< true: the keys have positions
    bool turns = false;               ///< true: the keys have rotations
    std::vector<TimedValue> speed;    ///< [1] speed of the local time; 1 before the first value
    std::vector<TimedValue> emitting; ///< 1: births, 0: no births; 1 before the first value
    std::vector<Trigger> triggers;
    std::vector<TimeJump> jumps;

    bool isEmpty() const
    {
        return keys.empty() && speed.empty() && emitting.empty() && triggers.empty() && jumps.empty();
    }
};

/// The last value with a time up to `time`; `before` if there is none.
double valueAt(const std::vector<TimedValue>& values, double time, double before);

/// Converts angles [degree] to a rotation about x, then y, then z.
glm::quat rotationOf(const glm::dvec3& degrees);

} // namespace fx::scene_file
