#include "simulation/world.h"

#include "foundation/simd/floating_point_scope.h"

#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <limits>

namespace fx::sim {

namespace {

/// Rotates a world vector into an instance's local space.
glm::vec3 toLocal(const base::Placement& placement, const glm::vec3& world)
{
    return glm::conjugate(placement.rotation) * world;
}

/// What the steps of one instance share. An instance is scaled with everything its preset says, gravity
/// included, so that it keeps its look; the host's wind is that of the world outside, so it shrinks as the
/// instance grows.
StepContext makeContext(const Environment& environment, const InstanceStart& start, const EffectDef& effect)
{
    StepContext context{};
    context.seed = start.seed;
    context.gravity = toLocal(start.placement, environment.gravity);
    context.wind = effect.wind +
                   toLocal(start.placement, start.parameters.wind) / std::max(start.placement.scale, 1e-6f);
    const bool hasGround = environment.hasGround && effect.hasGround;
    context.groundHeight = hasGround ? 0.0f : -std::numeric_limits<float>::infinity();
    context.parameters = &start.parameters;
    return context;
}

} // namespace

World::World(const base::SnapshotSchema* schema, base::TaskRunner* tasks, std::pmr::memory_resource* memory,
             const Environment& environment)
    : environment_(environment), schema_(schema), tasks_(tasks), memory_(memory), scratch_(memory)
{}

Slot World::add(std::shared_ptr<const EffectDef> effect, const InstanceStart& start)
{
    Instance instance;
    instance.solvers.reserve(effect->solvers.size());
    for (const std::unique_ptr<const SolverDef>& def : effect->solvers)
        instance.solvers.push_back(def->create(*schema_, memory_));
    instance.effect = std::move(effect);
    instance.start = start;
    instance.used = true;

    if (!free_.empty()) {
        const Slot slot = free_.back();
        instances_[slot] = std::move(instance);
        free_.pop_back();
        return slot;
    }
    free_.reserve(instances_.size() + 1); // remove() must not fail
    instances_.push_back(std::move(instance));
    return Slot(instances_.size() - 1);
}

void World::remove(Slot slot)
{
    instances_[slot] = Instance{};
    free_.push_back(slot);
}

void World::setPlacement(Slot slot, const base::Placement& placement)
{
    instances_[slot].start.placement = placement;
}

void World::setParameters(Slot slot, const InstanceParameters& parameters)
{
    instances_[slot].start.parameters = parameters;
}

bool World::finished(Slot slot, base::Ticks sceneTick) const
{
    const Instance& instance = instances_[slot];
    const base::Ticks local = sceneTick - instance.start.startTick;
    if (local < 0)
        return false;
    if (instance.effect->duration > 0 && local >= instance.effect->duration)
        return true;
    if (!instance.start.parameters.emitting && elementCount(slot) == 0)
        return true;
    return std::all_of(instance.solvers.begin(), instance.solvers.end(),
                       [local](const std::unique_ptr<Solver>& solver) { return solver->finished(local); });
}

uint32_t World::elementCount(Slot slot) const
{
    uint32_t count = 0;
    for (const std::unique_ptr<Solver>& solver : instances_[slot].solvers)
        count += solver->elementCount();
    return count;
}

const EffectDef& World::effect(Slot slot) const
{
    return *instances_[slot].effect;
}

StepCounters World::step(std::span<const Slot> active, base::Ticks tick, base::Ticks stepTicks)
{
    StepCounters counters;
    if (stepTicks <= 0)
        return counters;
    const base::FloatingPointScope floatingPoint;
    for (const Slot slot : active) {
        const Instance& instance = instances_[slot];
        StepContext context = makeContext(environment_, instance.start, *instance.effect);
        context.tasks = tasks_;
        context.scratch = &scratch_;
        context.counters = &counters;
        const base::Ticks parts = std::clamp<base::Ticks>(instance.effect->subSteps, 1, 16);
        for (base::Ticks part = 0; part < parts; ++part) {
            const base::Ticks from = tick + stepTicks * part / parts - instance.start.startTick;
            const base::Ticks to = tick + stepTicks * (part + 1) / parts - instance.start.startTick;
            context.tick = std::max<base::Ticks>(from, 0);
            context.stepTicks = to - context.tick;
            for (uint32_t i = 0; i < instance.solvers.size() && context.stepTicks > 0; ++i) {
                context.solverIndex = i;
                instance.solvers[i]->step(context);
                scratch_.reset();
            }
        }
    }
    return counters;
}

void World::publish(std::span<const Slot> active, base::FrameSnapshot& snapshot) const
{
    const base::FloatingPointScope floatingPoint;
    for (const Slot slot : active) {
        const Instance& instance = instances_[slot];
        base::GroupInfo info;
        info.instance = instance.start.instance;
        info.placement = instance.start.placement;
        for (uint32_t i = 0; i < instance.solvers.size(); ++i) {
            info.solver = i;
            instance.solvers[i]->publish(info, snapshot);
        }
    }
}

} // namespace fx::sim
