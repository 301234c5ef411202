/// @file cue_record.h
/// Keeps the events of particles that the host wants to know, for one step of the world.
#pragma once

#include "simulation/emitters/events/cue_sink.h"
#include "simulation/world/instance_clock.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

namespace fx::sim {

/// An event of a simulation, and the rule that applies to it.
struct CueEvent
{
    ParticleEvent event; ///< vectors are in the space of the instance, or of the world if `isInWorld`
    glm::dvec3 position; ///< [m] position, in the same space
    base::Ticks tick;    ///< scene time
    uint32_t order;      ///< order of the simulation in the step
    uint32_t rule;       ///< index among the rules of the emitter
    uint32_t cue;        ///< index in EffectDef::cues, or kNoCue
    bool isInWorld;
};

/// Keeps the first events of a step by scene time, as many as the capacity allows, and counts all. Events at
/// one time are in the order of simulations, then of event-ticks. The kept events do not depend on the order
/// of posting. The memory is allocated when the record is created.
class CueRecord final : public CueSink
{
public:
    /// @param capacity maximum number of kept events
    /// @param named    true: events of rules with a cue are recorded
    /// @param unnamed  true: events of rules without a cue are recorded
    CueRecord(std::pmr::memory_resource* memory, uint32_t capacity, bool named, bool unnamed)
        : kept_(memory), named_(named), unnamed_(unnamed)
    {
        kept_.reserve(capacity);
    }

    /// Begins a step: discards all events.
    void clear();
    /// Begins the events of a simulation, or continues them.
    /// @param order   order of the simulation in the step
    /// @param clock   clock of the simulation; must stay valid until the last event
    /// @param ioAsked counts the events of the simulation, with those that are not kept
    void select(uint32_t order, const InstanceClock& clock, uint64_t& ioAsked);
    void post(const ParticleEvent& event, const EventRule& rule, uint32_t number,
              const base::Placement* home) override;
    void lose(uint64_t count) override;
    /// Ends a step. The events are then in the order of simulations, and in the order of time within each.
    void sort();
    /// True if an event was posted or lost since clear().
    bool hasAny() const { return hasAny_; }
    /// Kept events of the simulation that was selected with `order`; sort() must have been called.
    std::span<const CueEvent> of(uint32_t order) const;

private:
    std::pmr::vector<CueEvent> kept_; ///< before sort() a heap, whose front is the last event
    bool named_;
    bool unnamed_;
    bool hasAny_ = false;
    uint32_t order_ = 0;
    const InstanceClock* clock_ = nullptr;
    uint64_t* asked_ = nullptr;
};

} // namespace fx::sim
