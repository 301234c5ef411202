/// @file cue_sink.h
/// Interface that receives the events of particles that the host wants to know.
#pragma once

#include "foundation/math/geometry.h"
#include "simulation/particles/event_rule.h"

#include <cstdint>

namespace fx::sim {

/// Receives events of the emitters of one simulation after another. Threads: one at a time.
class CueSink
{
public:
    virtual ~CueSink() = default;
    /// Receives an event to which rule `number` of the emitter applies.
    /// @param home placement of the space of the event; null: the space of the instance
    virtual void post(const ParticleEvent& event, const EventRule& rule, uint32_t number,
                      const base::Placement* home) = 0;
    /// Counts events that the emitter had no room for.
    virtual void lose(uint64_t count) = 0;
};

} // namespace fx::sim
