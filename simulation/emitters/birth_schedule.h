/// @file birth_schedule.h
/// When particles are born: integers only, so that no frame rate gains or loses one.
///
/// @formula birth-ticks
/// The tick at which a rate emitter gives birth to its particle i, and how many are born before a tick.
///
/// symbol   unit     meaning
///   r       1/s      birth rate, a whole multiple of 2^-32
///   F       1/s      ticks per second
///   psi     1        phase in [0, 1), a whole multiple of 2^-24, drawn from the instance's seed
///   D       1        2^32 F: one particle
///   q       1        2^32 r: what one tick adds
///   R       1        progress at the beginning of a step minus what has been born, -D < R <= 0
/// @derivation
///   Particle i is born at the tick floor((i + psi) F / r), which lies in [0, T) when i + psi < r T / F (1)
///   so ceil(r T / F - psi) particles are born before tick T (2) In integers, with progress P(0) = -psi D and
///   P(T + n) = P(T) + q n:
///       births in a step of n ticks = ceil((R + q n) / D) (3) birth j of the step happens floor((j D - R) /
///       q) ticks after its beginning                          (4)
///   Progress is a sum of integers: any partition of time into steps gives the same total.
/// @source    elementary
/// @deviation none
/// @valid     r <= 1e9 /s (larger is taken as that; NaN and negative as 0); 128-bit products below 2^126
/// @accuracy  exact for the rounded rate, whose relative error is <= 2^-33 / r
/// @tests     tests/simulation/test_birth_schedule.cpp
#pragma once

#include "simulation/emitters/emitter_def.h"
#include "simulation/state/state_reader.h"

#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

namespace fx::sim {

__extension__ typedef __int128 WideInt; ///< holds rate times time exactly

constexpr base::Ticks kForever = INT64_MAX / 4; ///< later than anything happens

/// One particle that is to be born.
struct Birth
{
    uint64_t index;   ///< running number within the emitter, ascending with the tick
    base::Ticks tick; ///< local time
};

/// Births of a step: how many there were, of which the first `stored` were written.
struct BirthCount
{
    uint64_t total = 0;
    uint32_t stored = 0;
};

/// An interval of local time and what the host wants of it.
struct BirthWindow
{
    base::Ticks begin;
    base::Ticks end;      ///< the next window begins here
    double intensity = 1; ///< multiplies rate and burst counts
    bool emitting = true; ///< false: what would be born in the window never is
};

/// Rate and bursts of one emitter, advanced window by window without gaps. Ties: bursts by declaration, then
/// rate.
class BirthSchedule
{
public:
    /// @param emission its `start` delays rate and bursts alike
    BirthSchedule(const Emission& emission, std::pmr::memory_resource* memory);

    /// Draws the phase. Before the first advance.
    void setPhase(float phase);
    /// All births of the window in order; those that do not fit into `out` are counted and keep their index.
    BirthCount advance(const BirthWindow& window, std::span<Birth> out);
    /// True when nothing can be born from `tick` on.
    bool exhausted(base::Ticks tick) const;

    /// What has been born so far; rate and bursts are the definition's.
    void save(StateWriter& writer) const;
    void restore(StateReader& reader);

private:
    struct ScheduledBurst
    {
        base::Ticks tick;
        uint32_t count;
    };
    struct Writer;

    float rate_;
    base::Ticks start_;
    base::Ticks end_;
    std::pmr::vector<ScheduledBurst> bursts_; ///< by tick, then by declaration
    size_t nextBurst_ = 0;
    WideInt progress_ = 0; ///< R
    uint64_t nextIndex_ = 0;
};

} // namespace fx::sim
