/// @file event_scan.h
/// Finds the events of an emitter's particles in a step to which the emitter's rules apply.
///
/// @formula particle-event-ticks
/// The ticks at which a particle is born, reaches an age and dies.
///
/// symbol   unit   meaning
///   b        tick   birth
///   g        tick   an age of a rule, or a multiple of it
///   d        tick   death: the first tick at which the particle is dead
///   s, e     tick   begin and end of the step
/// @derivation
///   The event of birth is at b, among the births of the step. The event of an age is at b + g if
///       s < b + g <= e and b + g < d                                                        (1)
///   The event of death is in the step if the particle is alive at max(s, b) and dead at e. Its tick is the
///   first at which the particle is dead, found by bisection, because a particle dies only once      (2)
///   Intervals that are open at their begin and closed at their end leave no gap and do not overlap. A
///   particle that dies in a step is found in that step, before its row is reused                         (3)
///   Position and velocity at that tick follow from the closed form of ballistic-motion. If motion is
///   integrated, the position is interpolated in time along the path of the step, with the final velocity (4)
/// @source    elementary
/// @deviation none
/// @valid     g > 0; if motion is integrated, a particle that lives less than a step and whose row is reused
///            within it has only the event of birth
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

/// [1, linear Rec. 709] Color over life of the particle in `row` at `tick`, including inherited color,
/// without brightness. For a medium, the color is the albedo.
glm::vec3 colorAt(const EmitterSettings& def, const ParticleStore& store, uint32_t row, base::Ticks tick);

/// Maximum number of contacts of a particle in one step with obstacles, the host's geometry and the ground.
constexpr uint32_t kMaxParticleContacts = 10;

/// The kinds of events and the properties of particles that the rules of an emitter need.
class EventInterest
{
public:
    /// Determines the events and properties that `rules` need.
    /// @param longest [tick] upper bound of the age of particles
    EventInterest(std::span<const EventRule> rules, base::Ticks longest);

    bool in(EventKind kind) const { return kinds_[size_t(kind)]; }
    bool inColor() const { return colors_; } ///< true: a rule needs the color of the particle
    /// Ages at which rules apply; ascending, without duplicates, at most kMaxEventAges.
    std::span<const base::Ticks> ages() const { return ages_; }
    /// Index in ages() of the first age greater than `age`.
    uint32_t firstAfter(base::Ticks age) const
    {
        return uint32_t(std::upper_bound(ages_.begin(), ages_.end(), age) - ages_.begin());
    }
    /// Maximum number of events of one particle in one step.
    uint32_t mostOfOne() const
    {
        return 3 + uint32_t(ages_.size()) + (in(EventKind::Collision) ? kMaxParticleContacts : 0);
    }
    /// True if `rule` applies to an event.
    bool answers(const EventRule& rule, const ParticleEvent& event) const;
    /// True if a rule may apply to the contact.
    bool counts(const TileContact& contact) const
    {
        return contact.speed >= (contact.isLast ? leastLastSpeed_ : leastSpeed_);
    }

private:
    std::array<bool, 5> kinds_{};
    bool colors_ = false;
    /// [m/s] Smallest speed threshold of the rules for contacts.
    float leastSpeed_ = std::numeric_limits<float>::infinity();
    float leastLastSpeed_ = leastSpeed_;
    std::vector<base::Ticks> ages_;
};

/// Lists of events, one per tile, so that threads do not share lists. The memory of the lists is limited. If
/// many tiles have many events in one step, some events are dropped. The dropped events do not depend on the
/// number of threads.
class EventRoom
{
public:
    EventRoom(base::Arena& scratch, uint32_t rows, uint32_t mostOfOne);
    EventList& of(uint32_t row) { return lists_[row / kTileRows]; }
    std::span<const EventList> lists() const { return lists_; }

private:
    std::span<EventList> lists_;
};

/// Finds events of particles whose motion has a closed form, or that have not moved yet.
struct EventScan
{
    const EventInterest& interest;
    const ParticleStore& store;
    AppearanceJob job;
    uint32_t emitter;
    base::Ticks begin; ///< beginning of the step
    base::Ticks end;

    /// Finds ages and deaths of particles that are alive at the beginning of the step, in the tile at `row`.
    void scanTile(uint32_t row, EventList& out) const;
    /// Finds all events of a particle that is born in this step, if the particle has a row.
    /// @param fed true: an event caused the birth
    void scanBirth(uint64_t index, bool fed, bool birthOnly, EventList& out) const;

private:
    void addAt(uint32_t row, base::Ticks tick, ParticleEvent event, EventList& out) const;
    void scanAges(uint32_t row, base::Ticks from, EventList& out) const;
};

/// Finds events of particles whose motion is integrated.
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
