/// @file event_list.h
/// Events of particles that cause births in other emitters.
///
/// @formula event-ticks
/// When an event happens, and in which order events are answered.
///
/// symbol   unit   meaning
///   b        tick   local time at which the particle's part of the step begins
///   n        tick   length of that part
///   c        1      contact: share of that part, 0..1
///   v, a     m/s, m/s2  velocity just before a contact, and what the particle is accelerated by
///   n        1      normal of the surface, towards the particle
///   l        m      lift, as in contact-path
///   u        m/s    least speed of a rule
/// @derivation
///   A contact happens at the tick b + floor(c n), at most b + n - 1, so that it belongs to the step that saw
///   it                                                                                      (1)
///   Contacts begin, they do not last: one is an event where -v.n >= u. A bouncing particle meets a plane at
///   w, e w, e^2 w ... for a first speed w, floor(ln(u / w) / ln e) + 1 times, however time is cut. A
///   resting or sliding one falls by the lift at most, -v.n = sqrt(2 l |a.n|), in every step: a contact of
///   one that was within 2 l of the surface when the step began and has gained more than half of its -v.n
///   since is none, nor are slower ones of that step                                                  (2)
///   Events are answered in the order of (tick, cause, emitter, index of the particle, kind, number), which
///   no partition of the work and of time changes: what an earlier event of the same tick caused comes
///   before what the clock or the host did                                                   (3)
/// @source    elementary
/// @deviation a particle that slides along a curved surface of radius R at a speed w meets it at about
///            w^2 t / R in each step t; one that is pressed against it at less than u raises no events
/// @valid     0 <= c <= 1, n >= 1; (2) where a step t has few bounces at u: 12 e u / |a| > t
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
    Age, ///< it reached the age that its rule names
    Collision,
    Death,
    Host, ///< triggered by the host
};

/// One event, with the values that a particle born from it inherits.
struct ParticleEvent
{
    base::Ticks tick; ///< local time
    uint64_t index;   ///< of the particle in its emitter
    uint32_t emitter; ///< solver index
    EventKind kind;
    glm::vec3 position;     ///< [m]
    glm::vec3 velocity;     ///< [m/s]
    glm::vec3 color{1.0f};  ///< [1] linear Rec. 709, where a rule needs it
    bool scheduled = false; ///< caused by the schedule or the host, not by a particle
    uint32_t number = 0; ///< which of the emitter's ages, with EventKind::Age; as TileContact with Collision
    float speed = 0.0f;  ///< [m/s] with Collision: see TileContact
    bool isLast = false; ///< with Collision: see TileContact
};

/// (3)
inline bool happensBefore(const ParticleEvent& a, const ParticleEvent& b)
{
    return std::tuple(a.tick, a.scheduled, a.emitter, a.index, a.kind, a.number) <
           std::tuple(b.tick, b.scheduled, b.emitter, b.index, b.kind, b.number);
}

/// (1)
inline base::Ticks contactTick(base::Ticks begin, base::Ticks ticks, float contact)
{
    const double share = double(contact > 0.0f ? (contact < 1.0f ? contact : 1.0f) : 0.0f);
    return begin + std::min(base::Ticks(share * double(ticks)), ticks - 1);
}

/// Events of one step in memory of the caller. Events beyond its capacity are counted. Threads: add() from
/// one; several threads have a list each, which append() joins in a fixed order.
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
    /// Sorts the events into processing order. Heap sort on unique keys: no allocation, and no two events are
    /// equal unless they are the same.
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
