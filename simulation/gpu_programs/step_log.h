/// @file step_log.h
/// Log of the steps of an emitter and their conditions, as runs of equal steps. The particles depend only on
/// this log and on the births.
#pragma once

#include "foundation/snapshot/gpu_modules.h"
#include "foundation/time/ticks.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

namespace fx::sim {

/// Conditions of a step.
struct StepConditions
{
    glm::vec3 gravity{0.0f}; ///< [m/s2] gravity in local space
    glm::vec3 wind{0.0f};    ///< [m/s] local wind, without the wind of the emitter itself
    float ground = 0.0f;     ///< [m] see StepContext::groundHeight
    float intensity = 1.0f;  ///< intensity of births
    bool emitting = true;

    bool operator==(const StepConditions&) const = default;
};

/// One step of a run.
struct LoggedStep
{
    base::Ticks begin, end;
    const StepConditions& conditions;
};

/// Log of the steps in a window of time.
class StepLog
{
    struct Run
    {
        base::Ticks begin;
        base::Ticks length;
        uint32_t count;
        uint64_t history; ///< hash of all previous steps and of the initial state
        StepConditions conditions;

        base::Ticks end() const { return begin + length * base::Ticks(count); }
        /// Index of the first step that ended after `tick`; `count` if there is none.
        uint32_t firstSince(base::Ticks tick) const
        {
            if (tick < begin)
                return 0;
            return tick >= end() ? count : uint32_t((tick - begin) / length);
        }
    };

public:
    explicit StepLog(std::pmr::memory_resource* memory) : runs_(memory) {}

    /// Clears the log. @param seed, solver random key of the following steps
    void clear(uint64_t seed, uint32_t solver);
    /// Adds a step. @param next index of the next birth before the step
    void add(base::Ticks begin, base::Ticks length, uint64_t next, const StepConditions& conditions);
    /// Removes steps that ended before `tick`.
    void forget(base::Ticks tick);

    size_t runs() const { return runs_.size(); }
    /// Number of steps that ended after `tick`.
    uint64_t stepsSince(base::Ticks tick) const;
    /// Calls take(const StepConditions&) for each run.
    template <class Take>
    void forEachRun(Take&& take) const
    {
        for (const Run& run : runs_)
            take(run.conditions);
    }
    /// Writes the runs for publication at `now`. @param out space for at least runs() elements
    void publish(base::Ticks now, std::span<base::GpuStepRun> out) const;
    /// Calls take(LoggedStep) for each step that ended after `tick`, in order.
    template <class Take>
    void forEachSince(base::Ticks tick, Take&& take) const
    {
        for (const Run& run : runs_)
            for (uint32_t i = run.firstSince(tick); i < run.count; ++i) {
                const base::Ticks begin = run.begin + run.length * base::Ticks(i);
                take(LoggedStep{begin, begin + run.length, run.conditions});
            }
    }

private:
    std::pmr::vector<Run> runs_; ///< runs in the order of time
    uint64_t history_ = 0;
};

} // namespace fx::sim
