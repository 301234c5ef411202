/// @file motion_history.h
/// Records the extremes of placement and wind of an instance over the lifetime of its particles.
///
/// Time is divided into intervals at least as long as the longest lifetime. All living particles were born
/// within the last two intervals. Two sets of extremes therefore suffice, however often the host moves the
/// instance.
#pragma once

#include "foundation/math/geometry.h"
#include "foundation/time/ticks.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <limits>

namespace fx::scene {

/// Placement and wind of an instance at one time, or their extremes over several times.
struct BoundsInputs
{
    glm::dvec3 low{std::numeric_limits<double>::infinity()}; ///< [m] world, range of positions
    glm::dvec3 high{-std::numeric_limits<double>::infinity()};
    float smallest = std::numeric_limits<float>::infinity(); ///< [1] smallest scale
    float largest = 0;
    float wind = 0;                ///< [m/s] world, wind of the host
    float localWind = 0;           ///< [m/s] wind in local space
    double speed = 0;              ///< [m/s] world, largest speed of births, in the instance's time
    uint32_t slowest = UINT32_MAX; ///< see sim::InstanceClock::rate

    void add(const BoundsInputs& more);
    bool operator==(const BoundsInputs&) const = default;
};

class MotionHistory
{
public:
    /// Records the present placement and wind, and starts a new interval if the current one is long enough.
    /// @param now [tick] scene time, increasing
    /// @param seconds [s] longest lifetime of particles, in the instance's time
    void note(base::Ticks now, const BoundsInputs& is, float seconds);
    /// Restarts the current interval at `now`. The function is for an instance whose local time has not
    /// advanced since the last call of note(), so that its particles have not aged.
    void restart(base::Ticks now) { begun_ = now; }
    /// Marks the extremes of the past as unknown.
    void forget() { unknown_ = 2; }

    bool isKnown() const { return unknown_ == 0; }
    /// True if all recorded inputs equal the present inputs. Then another call of note() has no effect.
    bool isSettled() const;
    BoundsInputs all() const;

private:
    BoundsInputs last_, newer_, older_;
    base::Ticks begun_ = 0;
    int unknown_ = 0; ///< number of intervals that must end until the extremes are known
};

} // namespace fx::scene
