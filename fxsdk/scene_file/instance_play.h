/// @file instance_play.h
/// Changes of one effect of a scene over time, which a host would make by API calls.
///
/// All times are those of the scene [s], not of the effect.
#pragma once

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace fx::scene_file {

/// Where the effect is at one time.
struct InstanceKey
{
    double time = 0;               ///< [s] later than that of the key before
    glm::dvec3 position{0};        ///< [m] world; not used unless the play moves
    glm::dvec3 rotationDegrees{0}; ///< about x, then y, then z; not used unless the play turns
};

/// A value that holds from a time on.
struct TimedValue
{
    double time = 0; ///< [s] later than that of the one before
    double value = 0;
};

/// An event of the host.
struct Trigger
{
    double time = 0; ///< [s] not before the instance's start or the trigger before
    std::string name;
    uint32_t count = 1;
};

/// A jump in the effect's own time.
struct TimeJump
{
    double time = 0; ///< [s] not before the instance's start or the jump before
    double to = 0;   ///< [s] since the effect's beginning
};

struct InstancePlay
{
    std::vector<InstanceKey> keys;
    bool moves = false;               ///< keys have positions
    bool turns = false;               ///< keys have rotations
    std::vector<TimedValue> speed;    ///< [1] before the first: 1
    std::vector<TimedValue> emitting; ///< 0 or 1; before the first: 1
    std::vector<Trigger> triggers;
    std::vector<TimeJump> jumps;

    bool isEmpty() const
    {
        return keys.empty() && speed.empty() && emitting.empty() && triggers.empty() && jumps.empty();
    }
};

/// The last value whose time is not in the future, `before` when no value is.
double valueAt(const std::vector<TimedValue>& values, double time, double before);

/// Rotation about x, then y, then z.
glm::quat rotationOf(const glm::dvec3& degrees);

} // namespace fx::scene_file
