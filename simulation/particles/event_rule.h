/// @file event_rule.h
/// Rules of an emitter's preset by which events cause births.
#pragma once

#include "simulation/particles/event_list.h"

#include <cstdint>

namespace fx::sim {

constexpr uint32_t kNoCue = ~0u;        ///< the rule has no cue
constexpr uint32_t kNoTarget = ~0u;     ///< the rule causes no births
constexpr uint32_t kMaxEventAges = 256; ///< maximum number of ages for one emitter, repetitions included
/// [m/s] Default minimum speed against the surface at a contact. A particle has this speed after a fall of 13
/// mm. A bouncing particle with a lower speed counts as resting.
constexpr float kUsualContactSpeed = 0.5f;

/// Rule of an emitter: an event of one of its particles causes births in another emitter, is reported to the
/// host, or both.
struct EventRule
{
    EventKind on = EventKind::Death;
    base::Ticks age = 0;   ///< for EventKind::Age: age of the particle at the first event, > 0
    base::Ticks every = 0; ///< interval at which the event repeats, > 0; 0: the event happens once
    /// For EventKind::Collision: [m/s] minimum speed against the surface, along its normal; see event-ticks.
    float minSpeed = kUsualContactSpeed;
    /// [m/s] like minSpeed, but for a contact at which the particle dies or sticks
    float minLastSpeed = 0.0f;
    uint32_t hostEvent = 0; ///< for EventKind::Host: index in EffectDef::hostEvents
    uint32_t cue = kNoCue;  ///< index in EffectDef::cues
    uint32_t target = 0;    ///< solver index of the emitter in which births happen, or kNoTarget
    uint32_t fewest =
        1; ///< smallest number of births that one event causes; the number is random in [fewest, most]
    uint32_t most = 1;
    float probability = 1.0f;     ///< [1] probability that the rule applies to an event, 0..1
    float inheritVelocity = 0.0f; ///< [1] fraction of the particle's velocity that is added to births, 0..1
    /// [1] Weight w of the particle's color, 0..1. The color of a birth is multiplied by (1 - w) + w times
    /// the particle's color.
    float inheritColor = 0.0f;
};

/// Births that one event causes in the target emitter.
struct EventBirth
{
    ParticleEvent cause; ///< event that causes the births; births inherit the velocity of the event
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
