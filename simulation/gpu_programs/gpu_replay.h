/// @file gpu_replay.h
/// Computes the rows of an emitter from the log of its births on the CPU, with the same bits as if it had
/// been stepped there.
#pragma once

#include "simulation/gpu_programs/step_log.h"
#include "simulation/particles/appearance_kernel.h"
#include "simulation/particles/birth_kernel.h"

#include <glm/vec3.hpp>

#include <functional>
#include <span>
#include <vector>

namespace fx::sim {

/// Conditions of ballistic particles from a time on.
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

/// [tick] Longer than any life, roundings included.
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
    /// The ticks of the births from `first` on, which do not fall.
    std::function<void(uint64_t first, std::span<base::Ticks> out)> ticksOf;
    std::span<const MotionCondition> conditions; ///< ascending, at least one
    base::Ticks now;
    bool placed;                            ///< see ParticleStore::placed
    std::span<const ReplayStep> steps = {}; ///< all in which they lived; where motion has no closed form
};

/// Fills `store` with the living particles. @return the job for their appearance
AppearanceJob replayBirths(const ParticleProgram& program, const ReplayInput& in, ParticleStore& store);
/// The same step by step.
AppearanceJob replaySteps(const ParticleProgram& program, const ReplayInput& in, ParticleStore& store);

/// Restarts closed-form motion at the present state.
void restartMotion(const AppearanceJob& job, ParticleStore& store);

/// As base::GpuParticleProgram::replay.
void replayGroup(const ParticleProgram& program, const base::SnapshotGroup& group, base::FrameSnapshot& out);

} // namespace fx::sim
