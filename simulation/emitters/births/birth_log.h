/// @file birth_log.h
/// Birth ticks of particles. The log stores runs of evenly spaced births instead of one entry per birth.
#pragma once

#include "foundation/snapshot/gpu_particles.h"
#include "foundation/time/ticks.h"

#include <cstddef>
#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

namespace fx::sim {

__extension__ typedef __int128 WideInt; ///< integer that can hold the product of a rate and a time exactly
/// integer that can hold the product of a 96-bit fraction and 2^32
__extension__ typedef unsigned __int128 WideWord;

/// Receives births from BirthSchedule in the order of their indices. The log has the births of a window of
/// time.
class BirthLog
{
public:
    explicit BirthLog(std::pmr::memory_resource* memory) : runs_(memory) { runs_.reserve(8); }

    /// Adds births at a constant rate: birth j at the tick begin + floor((j * one + sought) / rate).
    /// @param sought >= 0  @param one, rate > 0, see birth-ticks
    void addRate(uint64_t first, uint64_t count, base::Ticks begin, WideInt sought, WideInt one,
                 WideInt rate);
    void addBurst(uint64_t first, uint64_t count, base::Ticks tick);
    /// Removes all entries. The next birth that is added has the index `next`.
    void clear(uint64_t next);
    /// Removes runs of births that ended before `tick`, and advances front().
    void forget(base::Ticks tick);

    uint64_t front() const { return front_; } ///< index of the oldest birth in the log
    uint64_t next() const { return next_; }
    bool empty() const { return front_ == next_; }
    size_t runs() const { return runs_.size(); }
    /// Tick of a birth. @param index front() <= index < next()
    base::Ticks tickOf(uint64_t index) const;
    /// The tick of each of the births [first, first + out.size()).
    void ticksOf(uint64_t first, std::span<base::Ticks> out) const;
    /// Writes the runs for publication at `now`. @param out space for runs() elements
    void publish(base::Ticks now, std::span<base::GpuBirthRun> out) const;

private:
    /// A run of births. The tick of birth j of the run is tick + j * stride + floor(rest + j * fraction). The
    /// unit of rest and fraction is 2^-96.
    struct Run
    {
        uint64_t first;
        uint64_t count;
        base::Ticks tick;
        base::Ticks stride;
        WideWord fraction;
        WideWord rest;

        // Parameters of the run, to detect whether births continue unchanged. The rate of a burst is 0.
        base::Ticks begin;
        WideInt sought, one, rate;

        base::Ticks at(uint64_t j) const
        {
            return tick + base::Ticks(j) * stride + base::Ticks((rest + WideWord(j) * fraction) >> 96);
        }
        base::Ticks last() const { return at(count - 1); }
    };
    bool goesOn(const Run& run, uint64_t first, base::Ticks begin, WideInt sought, WideInt one,
                WideInt rate) const;
    size_t runOf(uint64_t index) const;

    std::pmr::vector<Run> runs_; ///< in ascending order, without gaps, up to next_
    uint64_t front_ = 0;
    uint64_t next_ = 0;
};

} // namespace fx::sim
