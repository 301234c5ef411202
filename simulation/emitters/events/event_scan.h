/// @file event_scan.h
/// Finds the events of an emitter's particles in a step for which it has rules.
///
/// @formula particle-event-ticks
/// At which tick a particle is born, reaches an age and dies.
///
/// symbol   unit   meaning
///   b        tick   birth
///   g        tick   an age that a rule names, or that it repeats
///   d        tick   death: the first tick at which the particle no longer lives
///   s, e     tick   begin and end of the step
/// @derivation
///   Birth happens at b, which lies in the step's own births; the age at b + g when
///       s < b + g <= e and b + g < d                                                        (1)
///   death when the particle lives at max(s, b) and no longer at e, at the first tick that it does not
///   live at; life only ends once, so halving the interval finds it                          (2)
///   Intervals that are open at their begin and closed at their end meet without gap or overlap, and a
///   particle that is dead at the end of a step has been seen before its row is forgotten    (3)
///   Place and velocity at that tick are the closed form of ballistic-motion; where motion is integrated,
///   the place lies on the straight way of the step, in proportion to time, with the velocity of its end (4)
/// @source    elementary
/// @deviation none
/// @valid     g > 0; a particle that lives less than a step whose row is reused within it, where motion is
///            integrated, has an event of birth only
/// @accuracy  ticks exact, for any partition into steps; places as ballistic-motion, or (4)
/// @tests     tests/simulation/particles/events/test_emitter_events.cpp
#pragma once

#include "foundation/memory/arena.h"
#include "simulation/particles/appearance_kernel.h"
#include "simulation/particles/emitter_settings.h"
#include "simulation/particles/event_rule.h"
#include "simulation/particles/tile_step.h"

#include <algorithm>
#include <array>
#include <limits>
#include <span>
#include <vector>

namespace fx::sim {

/// [1] linear Rec. 709: the color over life of the particle in `row`, or its albedo where it is a medium, at
/// `tick`, including inherited color, without brightness.
glm::vec3 colorAt(const EmitterSettings& def, const ParticleStore& store, uint32_t row, base::Ticks tick);

constexpr uint32_t kMaxParticleContacts = 10; ///< in one step: obstacles', the host's, the ground's

/// Properties of particles that the rules of an emitter need.
class EventInterest
{
public:
    /// @param longest [tick] no particle becomes older
    EventInterest(std::span<const EventRule> rules, base::Ticks longest);

    bool in(EventKind kind) const { return kinds_[size_t(kind)]; }
    bool inColor() const { return colors_; } ///< of the particle
    std::span<const base::Ticks> ages() const
    {
        return ages_;
    } ///< ascending, each once, at most kMaxEventAges
    /// Number of the first age beyond `age`.
    uint32_t firstAfter(base::Ticks age) const
    {
        return uint32_t(std::upper_bound(ages_.begin(), ages_.end(), age) - ages_.begin());
    }
    /// Events that one particle can have in one step.
    uint32_t mostOfOne() const
    {
        return 3 + uint32_t(ages_.size()) + (in(EventKind::Collision) ? kMaxParticleContacts : 0);
    }
    /// True when `rule` applies to an event.
    bool answers(const EventRule& rule, const ParticleEvent& event) const;
    /// True when some rule may be about a contact.
    bool counts(const TileContact& contact) const
    {
        return contact.speed >= (contact.isLast ? leastLastSpeed_ : leastSpeed_);
    }

private:
    std::array<bool, 5> kinds_{};
    bool colors_ = false;
    /// [m/s] smallest threshold of rules for contacts.
    float leastSpeed_ = std::numeric_limits<float>::infinity();
    float leastLastSpeed_ = leastSpeed_;
    std::vector<base::Ticks> ages_;
};

/// Lists of events, one a tile, so that threads need not meet. Its memory is limited: where many tiles have
/// many events in one step, some find no room, the same for any number of threads.
class EventRoom
{
public:
    EventRoom(base::Arena& scratch, uint32_t rows, uint32_t mostOfOne);
    EventList& of(uint32_t row) { return lists_[row / kTileRows]; }
    std::span<const EventList> lists() const { return lists_; }

private:
    std::span<EventList> lists_;
};

/// Looks at particles whose motion has a closed form, or that have not moved yet.
struct EventScan
{
    const EventInterest& interest;
    const ParticleStore& store;
    AppearanceJob job;
    uint32_t emitter;
    base::Ticks begin; ///< of the step
    base::Ticks end;

    /// Finds ages and deaths of particles that live at the begin of the step, in the tile at `row`.
    void scanTile(uint32_t row, EventList& out) const;
    /// Finds all events of a particle that is born in this step, if it has a row.
    /// @param fed its birth was caused by an event
    void scanBirth(uint64_t index, bool fed, bool birthOnly, EventList& out) const;

private:
    void addAt(uint32_t row, base::Ticks tick, ParticleEvent event, EventList& out) const;
    void scanAges(uint32_t row, base::Ticks from, EventList& out) const;
};

/// Looks at particles whose motion is integrated.
class EventWatch final : public TileWatch
{
public:
    EventWatch(const EmitterSettings& def, const EventInterest& interest, const ParticleStore& store,
               EventRoom& room)
        : def_(def), interest_(interest), store_(store), room_(room)
    {}
    void touch(const TileContext& context, const Tile& tile, uint32_t i, const TileContact& contact) override;
    void see(const TileContext& context, const Tile& tile, const ParticleStore& store) override;

private:
    const EmitterSettings& def_;
    const EventInterest& interest_;
    const ParticleStore& store_;
    EventRoom& room_;
};

} // namespace fx::sim
