/// @file gpu_replay.h
/// Computes the rows of an emitter on the CPU from the log of its births. The rows have the same bits as
/// after steps on the CPU.
#pragma once

#include "simulation/gpu_programs/step_log.h"
#include "simulation/particles/appearance_kernel.h"
#include "simulation/particles/birth_kernel.h"

#include <glm/vec3.hpp>

#include <functional>
#include <span>
#include <vector>

namespace fx::sim {

/// Acceleration of particles with closed-form motion, valid after the time `begin`.
struct MotionCondition
{
    base::Ticks begin; ///< local time
    glm::vec3 pull;    ///< [m/s2] see AppearanceJob
};

/// One step of particles whose motion has no closed form.
struct ReplayStep
{
    base::Ticks begin, end;
    glm::vec3 gravity; ///< see StepConditions
    glm::vec3 wind;
    float ground;
};

/// [tick] Upper bound of lifetimes, including rounding.
base::Ticks longestKept(const ParticleProgram& program);

/// The steps of a group that ended after `since`.
std::vector<ReplayStep> stepsOf(const base::SnapshotGroup& group, base::Ticks since);

/// Context of modules for one step, without memory and tasks.
StepContext contextOf(const ReplayStep& step, const BirthKey& key);

struct ReplayInput
{
    BirthKey key;
    uint64_t first; ///< births [first, next)
    uint64_t next;
    /// Writes the ticks of the births, beginning with birth `first`, to `out`. Ticks never decrease.
    std::function<void(uint64_t first, std::span<base::Ticks> out)> ticksOf;
    std::span<const MotionCondition> conditions; ///< conditions in the order of time, at least one
    base::Ticks now;
    bool placed; ///< see ParticleStore::placed
    /// All steps during the lives of the particles; used only for motion without a closed form.
    std::span<const ReplayStep> steps = {};
};

/// Fills `store` with the living particles. @return the job for the appearance of the particles
AppearanceJob replayBirths(const ParticleProgram& program, const ReplayInput& in, ParticleStore& store);
/// Fills `store` with the living particles, for motion without a closed form. The function replays all steps.
AppearanceJob replaySteps(const ParticleProgram& program, const ReplayInput& in, ParticleStore& store);

/// Restarts closed-form motion from the present state.
void restartMotion(const AppearanceJob& job, ParticleStore& store);

/// Implements base::GpuParticleProgram::replay.
void replayGroup(const ParticleProgram& program, const base::SnapshotGroup& group, base::FrameSnapshot& out);

} // namespace fx::sim
