/// @file event_list.h
/// Events of particles, which cause births in other emitters.
///
/// @formula event-ticks
/// The tick of an event, and the order in which events are processed.
///
/// symbol   unit   meaning
///   b        tick   local time at which the particle's part of the step begins
///   n        tick   length of that part
///   c        1      contact: share of that part, 0..1
///   v, a     m/s, m/s2  velocity just before a contact, and acceleration of the particle
///   n        1      normal of the surface, towards the particle
///   l        m      lift, as in contact-path
///   u        m/s    minimum speed of a rule
/// @derivation
///   A contact happens at the tick b + floor(c n), at most b + n - 1, so it belongs to the step in which it
///   is found                                                                                   (1)
///   Only the beginning of a contact with -v.n >= u is an event. A particle that bounces on a plane with the
///   speeds w, e w, e^2 w ... has floor(ln(u / w) / ln e) + 1 events, for any division of time.
///   A resting or sliding particle falls by at most the lift in every step, with -v.n = sqrt(2 l |a.n|).
///   Therefore a contact is no event if the particle was within 2 l of the surface at the begin of the step
///   and has gained more than half of -v.n since then. Slower contacts in the same step are no events
///   either                                                                                     (2)
///   Events are processed in the order of (tick, cause, emitter, index of the particle, kind, number). This
///   order does not depend on the division of work and time. At equal ticks, events caused by particles
///   precede those of the schedule and the host                                                 (3)
/// @source    elementary
/// @deviation a particle that slides along a curved surface of radius R at a speed w hits it at about w^2 t /
///            R in each step t; if this speed is below u, there are no events
/// @valid     0 <= c <= 1, n >= 1; (2) if a step t contains few bounces at u: 12 e u / |a| > t
/// @accuracy  one tick, 1.4 ns
/// @tests     tests/simulation/particles/modules/test_event_list.cpp,
///            tests/simulation/particles/events/test_contact_events.cpp
#pragma once

#include "foundation/time/ticks.h"

#include <glm/vec3.hpp>

#include <algorithm>
#include <cstdint>
#include <span>
#include <tuple>

namespace fx::sim {

/// Kinds of events.
enum class EventKind : uint8_t
{
    Birth,
    Age, ///< the particle has reached the age in the rule
    Collision,
    Death,
    Host, ///< the host has triggered the event
};

/// One event, with the values that a particle born from it inherits.
struct ParticleEvent
{
    base::Ticks tick; ///< local time
    uint64_t index;   ///< index of the particle in its emitter
    uint32_t emitter; ///< solver index
    EventKind kind;
    glm::vec3 position;     ///< [m]
    glm::vec3 velocity;     ///< [m/s]
    glm::vec3 color{1.0f};  ///< [1] color of the particle, linear Rec. 709; set only if a rule needs it
    bool scheduled = false; ///< true: the schedule or the host caused the event; false: a particle caused it
    /// For EventKind::Age: index among the ages of the emitter. For EventKind::Collision: see TileContact.
    uint32_t number = 0;
    float speed = 0.0f;     ///< [m/s] for EventKind::Collision: see TileContact
    bool isLast = false;    ///< for EventKind::Collision: see TileContact
    glm::vec3 normal{0.0f}; ///< [1] for EventKind::Collision: see TileContact
};

/// The order of events by equation (3).
inline bool happensBefore(const ParticleEvent& a, const ParticleEvent& b)
{
    return std::tuple(a.tick, a.scheduled, a.emitter, a.index, a.kind, a.number) <
           std::tuple(b.tick, b.scheduled, b.emitter, b.index, b.kind, b.number);
}

/// The tick of a contact by equation (1).
inline base::Ticks contactTick(base::Ticks begin, base::Ticks ticks, float contact)
{
    const double share = double(contact > 0.0f ? (contact < 1.0f ? contact : 1.0f) : 0.0f);
    return begin + std::min(base::Ticks(share * double(ticks)), ticks - 1);
}

/// Events of one step, in memory of the caller. Events beyond the capacity are counted. Threads: one thread
/// per list; append() joins the lists of several threads in a fixed order.
class EventList
{
public:
    explicit EventList(std::span<ParticleEvent> room) : room_(room) {}

    void add(const ParticleEvent& event)
    {
        if (count_ < room_.size())
            room_[count_++] = event;
        else
            ++dropped_;
    }
    void append(const EventList& other)
    {
        for (const ParticleEvent& event : other.events())
            add(event);
        dropped_ += other.dropped_;
    }
    /// Sorts the events into processing order by heap sort, without allocation. The order is unique, because
    /// different events have different keys.
    void sort()
    {
        std::make_heap(room_.begin(), room_.begin() + ptrdiff_t(count_), happensBefore);
        std::sort_heap(room_.begin(), room_.begin() + ptrdiff_t(count_), happensBefore);
    }

    std::span<const ParticleEvent> events() const { return room_.first(count_); }
    uint64_t dropped() const { return dropped_; }

private:
    std::span<ParticleEvent> room_;
    size_t count_ = 0;
    uint64_t dropped_ = 0;
};

} // namespace fx::sim
