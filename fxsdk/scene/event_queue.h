/// @file event_queue.h
/// Events of a scene that the host has not read yet.
#pragma once

#include "foundation/time/ticks.h"
#include "fxsdk/scene/id_table.h"
#include "simulation/world/cue_record.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <memory_resource>
#include <utility>
#include <vector>

namespace fx::scene {

enum class SceneEventKind : uint32_t
{
    Finished, ///< an instance has ended
    Born,
    Aged,
    Collided,
    Died,
    Triggered, ///< by the host
};

struct SceneEvent
{
    SceneEventKind kind = SceneEventKind::Finished;
    uint32_t cue = sim::kNoCue;
    LocalId instance = 0;
    uint64_t userData = 0;
    base::Ticks tick = 0;     ///< scene time
    glm::dvec3 position{0.0}; ///< [m] world
    glm::vec3 velocity{0.0f}; ///< [m/s] world
    glm::vec3 normal{0.0f};   ///< [1] world
    float speed = 0;          ///< [m/s] world
    uint32_t solver = 0;
    uint64_t particle = 0;
};

/// Keeps events in the order of steps, and within a step in the order of (time, instance, order of add()).
/// Of a step with more events than there is room for, the first ones are kept. The kept events do not depend
/// on the order of add() of different instances. The memory is allocated when the queue is created.
/// Threads: one at a time.
class EventQueue
{
public:
    EventQueue(std::pmr::memory_resource* memory, uint32_t capacity) : events_(memory)
    {
        events_.reserve(capacity);
    }

    /// Adds an event to the open step.
    /// @param serial order of the instance
    void add(const SceneEvent& event, uint64_t serial);
    /// Counts events that were not passed to add().
    void lose(uint64_t count) { lost_ += count; }
    /// Ends the open step, so that its events can be read.
    void closeStep();

    uint32_t count() const { return closed_; } ///< number of events that can be read
    /// Calls f(event) for the first events and removes them.
    /// @param number at most count()
    template <class F>
    void take(uint32_t number, F&& f)
    {
        for (uint32_t i = 0; i < number; ++i)
            f(std::as_const(events_[i].event));
        events_.erase(events_.begin(), events_.begin() + ptrdiff_t(number));
        closed_ -= number;
    }
    uint64_t lost() const { return lost_; } ///< number of lost events since the queue was created
    /// Discards all events, without counting them as lost.
    void clear();

private:
    struct Entry
    {
        SceneEvent event;
        uint64_t serial;
        uint64_t number; ///< of add() in the step
    };
    static bool isBefore(const Entry& a, const Entry& b);

    std::pmr::vector<Entry> events_; ///< the open step begins at closed_; it is a heap, whose front is last
    uint32_t closed_ = 0;
    uint64_t numbers_ = 0;
    uint64_t lost_ = 0;
};

} // namespace fx::scene
