/// @file gpu_emitter.h
/// Log of an emitter's births and conditions, from which the GPU computes the particles. The log is always
/// recorded. While the GPU computes the emitter, the CPU stores no particles: births are only counted, and
/// the log is published. The rows of the particles can be restored bit for bit at any time.
#pragma once

#include "simulation/emitters/births/birth_log.h"
#include "simulation/gpu_programs/gpu_replay.h"
#include "simulation/gpu_programs/step_log.h"
#include "simulation/particles/reach/particle_reach.h"

#include <limits>
#include <memory_resource>
#include <vector>

namespace fx::sim {

class GpuEmitter
{
public:
    /// Creates the logs of one emitter.
    /// @param program a program that the GPU can compute; must outlive this object
    GpuEmitter(const ParticleProgram& program, std::pmr::memory_resource* memory);

    /// Log of births, written by BirthSchedule.
    BirthLog& log() { return log_; }
    const BirthLog& log() const { return log_; }

    /// Clears the log and ends GPU computation. History before `now` is unknown, unless `now` is 0.
    void clear(const BirthKey& key, base::Ticks now, uint64_t next, const glm::vec3& pull);
    /// Records a step, for motion without a closed form. Must be called before the step is computed.
    void noteStep(const StepContext& context);
    /// Records a change of gravity or wind.
    void setPull(base::Ticks now, const glm::vec3& pull);
    /// Records that births were dropped before `now`.
    void noteDrop(base::Ticks now) { dropped_ = now; }
    /// True if all births since the last forget() had free rows, by a conservative bound.
    bool surelyFits() const { return log_.next() - log_.front() <= rows_; }
    /// Removes entries of particles that are dead at `now`.
    void forget(base::Ticks now);

    /// True if a step needs a feature that the GPU does not support.
    bool asksTooMuch(const StepContext& context) const
    {
        constexpr base::Ticks kLongest = std::numeric_limits<uint32_t>::max(); // about 6 s
        return (dependsOnHost_ && (context.collider || context.contactHook)) ||
               (steps_ && context.stepTicks > kLongest);
    }
    /// True if particles may die before the end of their lifetime.
    bool kills() const { return kills_; }
    bool isOn() const { return on_; }
    /// True if the log covers all particles alive at `now` and is small enough for publication.
    bool mayBegin(base::Ticks now) const;
    bool mayGoOn(base::Ticks now) const;
    void begin() { on_ = true; }
    void end() { on_ = false; }

    /// Upper bound of the number of living particles, which is also the number of logged births.
    uint32_t count() const { return uint32_t(log_.next() - log_.front()); }
    /// True if no particle is alive at `now`. After the last birth, all births are examined once and the
    /// result is cached.
    bool isEmpty(const BirthKey& key, base::Ticks now) const;

    /// Restores the rows of the particles at `now`. @param store store that is filled; the member `placed`
    /// does not change
    AppearanceJob rebuild(const BirthKey& key, base::Ticks now, ParticleStore& store) const;
    /// Adds a group of the kind "gpuParticle".
    void publish(const base::GroupInfo& base, base::KindId kind, const BirthKey& key, base::Ticks now,
                 base::FrameSnapshot& snapshot) const;

private:
    float oldestAge(base::Ticks now) const; ///< [s] upper bound of the age of living particles
    base::Bounds bounds(base::Ticks now, float secondsBack) const;
    ConditionsRange conditionsRange(base::Ticks now) const;
    base::Ticks lastDeath(const BirthKey& key) const;

    const ParticleProgram& program_;
    uint32_t rows_;
    /// [tick] length of the window of time that the logs cover; longer than any lifetime
    base::Ticks window_;
    bool steps_; ///< true if the motion has no closed form
    bool kills_;
    bool dependsOnHost_;
    bool meetsGround_ = false; ///< see ConditionsRange
    bool meetsOthers_ = false;
    BirthLog log_;
    StepLog stepLog_;
    /// conditions in the order of time; the first condition applies to the oldest living particle
    std::pmr::vector<MotionCondition> conditions_;
    base::Ticks known_ = 0; ///< [tick] local time since which all steps are recorded
    base::Ticks dropped_ =
        -1; ///< [tick] local time before which births were dropped; -1: no birth was dropped
    bool on_ = false;
    mutable uint64_t deathsOf_ = ~uint64_t(0); ///< index of the next birth when lastDeath_ was computed
    mutable base::Ticks lastDeath_ = 0;
};

} // namespace fx::sim
