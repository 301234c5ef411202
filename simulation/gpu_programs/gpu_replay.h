/// @file gpu_replay.h
/// The rows of an emitter from nothing but its births: what the GPU computes, on the CPU and bit for bit as
/// if it had been stepped there all along.
#pragma once

#include "simulation/gpu_programs/step_log.h"
#include "simulation/particles/birth_kernel.h"
#include "simulation/particles/look_kernel.h"

#include <glm/vec3.hpp>

#include <functional>
#include <span>
#include <vector>

namespace fx::sim {

/// What acts on ballistic particles from a moment on.
struct MotionCondition
{
    base::Ticks begin; ///< local time
    glm::vec3 pull;    ///< [m/s2] see LookJob
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

/// What modules get for one of them; neither memory nor tasks.
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

/// Fills `store` with what lives of the births. @return what there is to be looked at
LookJob replayBirths(const ParticleProgram& program, const ReplayInput& in, ParticleStore& store);
/// The same step by step.
LookJob replaySteps(const ParticleProgram& program, const ReplayInput& in, ParticleStore& store);

/// From now on, motion begins where it has come to.
void restartMotion(const LookJob& job, ParticleStore& store);

/// As base::GpuParticleProgram::replay.
void replayGroup(const ParticleProgram& program, const base::SnapshotGroup& group, base::FrameSnapshot& out);

/// Whose group is published, and of which kind.
struct GroupPlace
{
    base::KindId kind;
    const base::GroupInfo& base;
};

/// Publishes rows as a group of the kind of particles, as Solver::proceedPublication().
/// @param tasks null: on the calling thread
bool publishRows(const LookJob& job, const GroupPlace& group, base::TaskRunner* tasks,
                 base::FrameSnapshot& snapshot, PublicationPlace& place, base::WorkBudget& work);

/// What is drawn within lives of at most `seconds` stays in this box, whatever is drawn at random.
/// @param low, high   [m/s2] between these are the pulls, component by component
/// @param secondsBack [s] to the snapshot before, on the way from which those who were born since are drawn
base::Bounds boundsOfAll(const EmitterDef& def, const glm::vec3& low, const glm::vec3& high, float seconds,
                         float secondsBack);

/// What has acted on particles since the oldest of them was born, besides modules.
struct StepWeather
{
    ReachConditions strongest; ///< and how long that is
    glm::vec3 low{0.0f};       ///< [m/s2] between these were the pulls of gravity and wind, see LookJob
    glm::vec3 high{0.0f};
    float lowGround = 0.0f; ///< [m] between these was the ground plane, -infinity for none
    float highGround = 0.0f;
    float secondsBack = kLongestStep; ///< [s] see boundsOfAll()
    bool meetsGround = false;         ///< particles do not fall below it
    bool meetsOthers = false;         ///< they may go anywhere from there
};

/// As boundsOfAll() where modules move particles; infinite when nobody knows.
base::Bounds boundsOfStepped(const EmitterDef& def, const StepWeather& weather);

} // namespace fx::sim
