/// @file wake_queue.h
/// What waits for its start, earliest first. Waiting costs nothing per step.
#pragma once

#include "foundation/time/ticks.h"

#include <cstdint>
#include <memory_resource>
#include <vector>

namespace fx::activation {

/// Something that is to wake. Keys are small numbers, each in the queue at most once.
struct Sleeper
{
    base::Ticks start = 0; ///< [tick] scene time
    uint64_t serial = 0;   ///< order of creation: decides between equal starts
    uint32_t key = 0;
};

/// A binary heap with the position of each key, so that any sleeper can be removed in logarithmic time.
class WakeQueue
{
public:
    explicit WakeQueue(std::pmr::memory_resource* memory) : heap_(memory), slots_(memory) {}

    /// Makes sure that add() of keys up to `key` does not allocate up to a size of `count`.
    void reserve(uint32_t key, size_t count);
    /// Strong guarantee.
    void add(const Sleeper& sleeper);
    /// The key must be in the queue. Allocates nothing.
    void remove(uint32_t key);
    bool empty() const { return heap_.empty(); }
    size_t size() const { return heap_.size(); }
    const Sleeper& earliest() const { return heap_.front(); } ///< not of an empty queue

private:
    void put(size_t at, const Sleeper& sleeper);
    void rise(size_t at);
    void sink(size_t at);

    std::pmr::vector<Sleeper> heap_;
    std::pmr::vector<uint32_t> slots_; ///< by key: index in heap_
};

} // namespace fx::activation
