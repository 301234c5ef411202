/// @file event_rule.h
/// Rules of an emitter's preset by which events cause births.
#pragma once

#include "simulation/particles/event_list.h"

#include <cstdint>

namespace fx::sim {

constexpr uint32_t kMaxEventAges = 256; ///< maximum for one emitter, including repetitions
/// [m/s] Minimum speed against the surface. A bouncing particle below it counts as resting. It is the speed
/// after a fall of 13 mm.
constexpr float kUsualContactSpeed = 0.5f;

/// An event of a particle of one emitter causes births of particles in another emitter.
struct EventRule
{
    EventKind on = EventKind::Death;
    base::Ticks age = 0;   ///< with EventKind::Age: age of the particle at the event, > 0
    base::Ticks every = 0; ///< > 0: interval at which the event repeats; 0: once
    /// With EventKind::Collision: [m/s] minimum speed against the surface, along its normal; see event-ticks.
    float minSpeed = kUsualContactSpeed;
    float minLastSpeed = 0.0f; ///< [m/s] as minSpeed, for a contact at which the particle dies or sticks
    uint32_t hostEvent = 0;    ///< with EventKind::Host: index in EffectDef::hostEvents
    uint32_t target = 0;       ///< solver index of the emitter in which births happen
    uint32_t fewest = 1;       ///< births of one event, drawn from [fewest, most]
    uint32_t most = 1;
    float probability = 1.0f;     ///< [1] 0..1, probability of births
    float inheritVelocity = 0.0f; ///< [1] 0..1 share of the particle's velocity that is added to births
    /// [1] 0..1, blends the births' color with its product with the particle's color
    float inheritColor = 0.0f;
};

/// Births that one event causes in the target emitter.
struct EventBirth
{
    ParticleEvent cause; ///< its velocity is inherited
    uint32_t rule;       ///< index among the rules of the emitter in which the event happened
    uint32_t count;
};

inline bool comesBefore(const EventBirth& a, const EventBirth& b)
{
    if (happensBefore(a.cause, b.cause) || happensBefore(b.cause, a.cause))
        return happensBefore(a.cause, b.cause);
    return a.rule < b.rule;
}

} // namespace fx::sim
