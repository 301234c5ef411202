/// @file event_rule.h
/// Rules of an emitter's preset for its events.
#pragma once

#include "simulation/particles/event_list.h"

#include <cstdint>

namespace fx::sim {

constexpr uint32_t kMaxEventAges = 256; ///< of one emitter, repetitions included
/// [m/s] against the surface: below it, a bouncing particle counts as resting. It is the speed after a fall
/// of 13 mm.
constexpr float kUsualContactSpeed = 0.5f;

/// An event of a particle of one emitter causes births of particles in another emitter.
struct EventRule
{
    EventKind on = EventKind::Death;
    base::Ticks age = 0;   ///< with EventKind::Age: how old a particle is then, > 0
    base::Ticks every = 0; ///< > 0: and again whenever it has become so much older
    /// With EventKind::Collision: [m/s] least speed against the surface, along its normal; see event-ticks.
    float minSpeed = kUsualContactSpeed;
    float minLastSpeed = 0.0f; ///< [m/s] the same for a contact that kills or sticks, which happens once
    uint32_t hostEvent = 0;    ///< with EventKind::Host: number in EffectDef::hostEvents
    uint32_t target = 0;       ///< solver index of the emitter that gives birth
    uint32_t fewest = 1;       ///< births of one event, drawn from [fewest, most]
    uint32_t most = 1;
    float probability = 1.0f;     ///< [1] 0..1, probability of births
    float inheritVelocity = 0.0f; ///< [1] 0..1 share of the particle's velocity that is added to births
    float inheritColor = 0.0f;    ///< [1] 0..1: from their own color to that times the particle's
};

/// Births that one event causes in the target emitter.
struct EventBirth
{
    ParticleEvent cause; ///< its velocity is inherited
    uint32_t rule;       ///< number among the rules of the emitter that it happened in
    uint32_t count;
};

inline bool comesBefore(const EventBirth& a, const EventBirth& b)
{
    if (happensBefore(a.cause, b.cause) || happensBefore(b.cause, a.cause))
        return happensBefore(a.cause, b.cause);
    return a.rule < b.rule;
}

} // namespace fx::sim
