/// @file birth_schedule.h
/// Birth times of particles, in integer arithmetic, so that the number of births does not depend on the frame
/// rate.
///
/// @formula birth-ticks
/// The birth tick of particle i of a rate emitter, and the number of births before a tick.
///
/// symbol   unit     meaning
///   r       1/s      birth rate, a whole multiple of 2^-32
///   F       1/s      ticks per second
///   psi     1        phase in [0, 1), a whole multiple of 2^-24, drawn from the instance's seed
///   D       1        progress per particle: 2^32 F, or 2^48 F if the rate changes
///   q       1        progress in the first tick of a piece of time
///   m       1        increase of the progress per tick from one tick to the next, 0 for a constant rate
///   R       1        progress at the beginning of a piece minus D per particle born, -D < R <= 0
///   L       1        ticks of a 64th of the duration
/// @derivation
///   Particle i is born at the tick floor((i + psi) F / r), which lies in [0, T) when i + psi < r T / F (1)
///   so ceil(r T / F - psi) particles are born before tick T                                 (2)
///   In integers, the progress begins at P(0) = -psi D, and n ticks of a piece add
///       S(n) = q n + m n (n - 1) / 2,   q = 2^32 r                                              (3)
///   The number of births of the piece before its tick n is ceil((R + S(n)) / D). Its birth j is at the
///   largest n with
///       S(n) <= j D - R,   for m = 0 that is floor((j D - R) / q)                               (4)
///   If the rate changes linearly from ra to rb over L ticks, with D = 2^48 F,
///       q = 2^48 ra + m k at tick k of it,   m = 2^48 (rb - ra) / L rounded towards 0           (5)
///   Progress is a sum of integers, and S(k + n) = S(k) + S(n) of the piece that begins at k. Therefore any
///   partition of time into steps gives the same births. At a constant rate there is no birth within
///   floor(-R / q) ticks of a moment. Windows that end within that time are merged, and their progress is
///   added later                                                                                   (6)
/// @source    elementary
/// @deviation none
/// @valid     r <= 1e9 /s (larger rates are limited to it; NaN and negative rates count as 0); a rate that
///            changes over more than 1e6 s is taken as constant; 128-bit products below 2^126
/// @accuracy  exact for the rounded rate, whose relative error is <= 2^-33 / r; (5) loses up to L 2^-48 /s
/// @tests     tests/simulation/test_birth_schedule.cpp
///            tests/simulation/particles/modules/test_birth_rates.cpp
#pragma once

#include "simulation/emitters/births/birth_log.h"
#include "simulation/particles/birth.h"
#include "simulation/particles/emitter_settings.h"
#include "simulation/state/state_reader.h"

#include <cstdint>
#include <memory_resource>
#include <optional>
#include <span>
#include <type_traits>
#include <vector>

namespace fx::sim {

/// Number of births of a step. The stored births are the first births of the step.
struct BirthCount
{
    uint64_t total = 0;
    uint64_t stored = 0;
};

/// An interval of local time, with the host's parameters during it.
struct BirthWindow
{
    base::Ticks begin;
    base::Ticks end;      ///< end of the interval and beginning of the next window
    double intensity = 1; ///< factor on rate and burst counts
    bool emitting = true; ///< false: births of the window are discarded
};

/// Evenly spaced births at a constant rate. Equation (4) of birth-ticks computes the births without division.
struct EvenBirths
{
    base::Ticks tick = kForever; ///< tick of the next birth
    base::Ticks stride = 0;      ///< number of whole ticks between births
    uint64_t rest = 0;           ///< remainder of the division for `tick`
    uint64_t more = 0;           ///< increase of `rest` from birth to birth
    uint64_t rate = 1;           ///< q, the divisor

    void goOn()
    {
        tick += stride;
        rest += more;
        if (rest >= rate) {
            rest -= rate;
            ++tick;
        }
    }
};

/// Rate and bursts of one emitter, advanced window by window without gaps. At the same tick, births of bursts
/// come before births of the rate. Bursts are in the order of declaration.
class BirthSchedule
{
public:
    /// Creates the schedule of an emitter.
    /// @param emission births; `start` delays rate and bursts, and endless bursts end with the duration
    BirthSchedule(const Emission& emission, std::pmr::memory_resource* memory);

    /// Sets the random phase. Must be called before the first advance().
    void setPhase(float phase);
    /// Sets the random key of bursts with a probability below 1. Must be called before the first advance().
    void setSeed(uint64_t seed, uint32_t solverIndex);
    /// Sets the log to which all births at constant rates are added; null: no log. The log must outlive the
    /// schedule.
    void setLog(BirthLog* log) { log_ = log; }
    /// Writes all births of the window to `out`, in order. Births that do not fit are counted, and their
    /// indices are not reused.
    BirthCount advance(const BirthWindow& window, std::span<Birth> out);
    /// Passes up to `most` births of the window to `take`. The function calls `take` whenever `room` is full,
    /// and at the end of the window.
    /// @param take called as take(std::span<const Birth>)
    template <class Take>
    BirthCount advance(const BirthWindow& window, std::span<Birth> room, uint64_t most, Take&& take)
    {
        const auto call = [](void* user, std::span<const Birth> births) {
            (*static_cast<std::remove_reference_t<Take>*>(user))(births);
        };
        base::Ticks end;
        return advanceTo(window, {room, most, call, &take}, end);
    }
    /// Passes births of the window to `take`, and stops after about `wanted` births, at least one.
    /// @param outReached beginning of the next window. The time is at or before the end of this window, and
    /// may
    ///         be between two births of the same tick
    template <class Take>
    BirthCount advance(const BirthWindow& window, std::span<Birth> room, uint64_t most, uint64_t wanted,
                       base::Ticks& outReached, Take&& take)
    {
        const auto call = [](void* user, std::span<const Birth> births) {
            (*static_cast<std::remove_reference_t<Take>*>(user))(births);
        };
        return advanceTo(window, {room, most, call, &take, wanted}, outReached);
    }
    /// Local time before which there are no births if the conditions of the last window do not change; 0 if
    /// unknown. Windows up to this time may be skipped.
    base::Ticks quietUntil() const { return quiet_.until; }
    /// Skips windows up to `tick`. Has no effect if the schedule has already passed `tick`.
    void passTo(base::Ticks tick)
    {
        if (tick > quiet_.to && tick <= quiet_.until)
            quiet_.to = tick;
    }
    /// All births from `tick` until end(), if the host's parameters do not change. `tick` must be the end of
    /// the last window. There is no value unless the births have a constant rate of at least 1e-3 [1/s].
    std::optional<EvenBirths> evenBirths(base::Ticks tick, double intensity, bool emitting) const;
    base::Ticks end() const { return end_; } ///< end of the rate
    /// True if there are no births at or after `tick`.
    bool exhausted(base::Ticks tick) const;
    /// Lower bound of the time of the next birth after `tick`, if the host's parameters do not change. `tick`
    /// must be the end of the last window.
    base::Ticks quietUntil(base::Ticks tick, double intensity, bool emitting) const;

    /// Saves the progress of births. Rate and bursts are not saved, because they belong to the definition.
    /// @param now windows up to this tick count as skipped, see passTo()
    void save(StateWriter& writer, base::Ticks now = 0) const;
    void restore(StateReader& reader);

private:
    struct ScheduledBurst
    {
        base::Ticks tick;     ///< tick of the first cycle
        base::Ticks interval; ///< [tick] time between cycles
        uint64_t cycles;
        uint32_t count;
        float probability;
        uint64_t next = 0;  ///< index of the next cycle
        uint32_t given = 0; ///< number of births of the next cycle that are already done

        base::Ticks nextTick() const
        {
            return next < cycles ? tick + base::Ticks(next) * interval : kForever;
        }
    };
    /// A time interval in which the rate is linear.
    struct Piece
    {
        base::Ticks begin, end;
        WideInt rate;  ///< symbol q of the formula
        WideInt slope; ///< symbol m of the formula

        WideInt sum(base::Ticks n) const; ///< progress during the first n ticks, symbol S of the formula
        base::Ticks tickOf(WideInt sum) const;
    };
    /// Destination of births.
    struct Outlet
    {
        std::span<Birth> room;
        uint64_t most; ///< maximum number of births to pass on
        /// function that receives births; null: births stay in `room`
        void (*take)(void* user, std::span<const Birth>);
        void* user;
        uint64_t wanted = UINT64_MAX; ///< number of births after which the window may end early
    };
    struct Writer;

    /// Skipped windows without births, which are not yet added to the progress.
    struct Quiet
    {
        base::Ticks from = 0;
        base::Ticks to = 0;    ///< the windows cover [from, to)
        base::Ticks until = 0; ///< no births before this time if the conditions do not change
        double intensity = 0;
        bool emitting = false;
        WideInt rate = 0; ///< symbol q of the formula
    };

    BirthCount advanceTo(const BirthWindow& window, const Outlet& outlet, base::Ticks& outReached);
    bool staysQuiet(const BirthWindow& window);
    void endQuiet();
    void findQuiet(const BirthWindow& window);
    WideInt particle() const; ///< progress per particle, symbol D of the formula
    Piece pieceAt(base::Ticks tick, base::Ticks end, const BirthWindow& window) const;
    base::Ticks giveRate(base::Ticks from, base::Ticks to, const BirthWindow& window, Writer& writer);
    bool giveBurst(ScheduledBurst& burst, const BirthWindow& window, Writer& writer);
    ScheduledBurst* nextBurst(base::Ticks end);
    bool happens(const ScheduledBurst& burst) const;

    Quiet quiet_; ///< first member, because most steps read only this member
    float rate_;
    base::Ticks start_;
    base::Ticks end_;
    base::ScalarCurve shape_;
    bool curved_;
    std::pmr::vector<ScheduledBurst> bursts_; ///< in the order of declaration
    uint64_t seed_ = 0;
    uint32_t solverIndex_ = 0;
    WideInt progress_ = 0; ///< symbol R of the formula
    uint64_t nextIndex_ = 0;
    BirthLog* log_ = nullptr;
};

} // namespace fx::sim
