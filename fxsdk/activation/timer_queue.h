/// @file timer_queue.h
/// A queue of timers, earliest first. A pending timer costs nothing per step.
#pragma once

#include "foundation/time/ticks.h"

#include <cstdint>
#include <memory_resource>
#include <vector>

namespace fx::activation {

/// A pending timer. Keys are small numbers. Each key is in the queue at most once.
struct Timer
{
    base::Ticks start = 0; ///< [tick] scene time
    uint64_t serial = 0;   ///< order of creation; decides between equal starts
    uint32_t key = 0;
};

/// A binary heap with the position of each key, so that any timer can be removed in logarithmic time.
class TimerQueue
{
public:
    explicit TimerQueue(std::pmr::memory_resource* memory) : heap_(memory), slots_(memory) {}

    /// Reserves memory for keys up to `key` and for `count` timers. Within these limits, add() allocates
    /// nothing.
    void reserve(uint32_t key, size_t count);
    /// Adds a timer. Strong exception guarantee.
    void add(const Timer& timer);
    /// Removes a timer. The key must be in the queue. Allocates nothing.
    void remove(uint32_t key);
    bool empty() const { return heap_.empty(); }
    size_t size() const { return heap_.size(); }
    /// the earliest timer; the queue must not be empty
    const Timer& earliest() const { return heap_.front(); }

private:
    void put(size_t at, const Timer& timer);
    void rise(size_t at);
    void sink(size_t at);

    std::pmr::vector<Timer> heap_;
    std::pmr::vector<uint32_t> slots_; ///< index in heap_ of the timer of each key
};

} // namespace fx::activation
