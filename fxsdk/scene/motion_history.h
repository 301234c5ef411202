/// @file motion_history.h
/// Extremes of placement and wind of an instance over the lifetime of its particles.
///
/// Time is divided into intervals at least as long as the longest lifetime. All living particles were born
/// within the last two intervals, so two sets of extremes suffice, however often the host moves the instance.
#pragma once

#include "foundation/math/geometry.h"
#include "foundation/time/ticks.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <limits>

namespace fx::scene {

/// The inputs at one time, or their extremes over several times.
struct BoundsInputs
{
    glm::dvec3 low{std::numeric_limits<double>::infinity()}; ///< [m] world, of positions
    glm::dvec3 high{-std::numeric_limits<double>::infinity()};
    float smallest = std::numeric_limits<float>::infinity(); ///< [1] scale
    float largest = 0;
    float wind = 0;                ///< [m/s] world, the host's
    float localWind = 0;           ///< [m/s] local
    double speed = 0;              ///< [m/s] world, of births, in the instance's time
    uint32_t slowest = UINT32_MAX; ///< see sim::InstanceClock::rate

    void add(const BoundsInputs& more);
    bool operator==(const BoundsInputs&) const = default;
};

class MotionHistory
{
public:
    /// @param now [tick] of the scene, rising
    void note(base::Ticks now, const BoundsInputs& is, float seconds);
    /// No time of the instance has passed before `now` since the last note.
    void restart(base::Ticks now) { begun_ = now; }
    /// The past is unknown.
    void forget() { unknown_ = 2; }

    bool isKnown() const { return unknown_ == 0; }
    /// True when all past inputs equal the present ones, so that further equal notes have no effect.
    bool isSettled() const;
    BoundsInputs all() const;

private:
    BoundsInputs last_, newer_, older_;
    base::Ticks begun_ = 0;
    int unknown_ = 0; ///< parts of time that have to end
};

} // namespace fx::scene
