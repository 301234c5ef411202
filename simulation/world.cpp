#include "simulation/world.h"

#include "foundation/simd/floating_point_scope.h"
#include "simulation/placed_contact.h"

#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>

namespace fx::sim {

namespace {

/// Rotates a world vector into an instance's local space.
glm::vec3 toLocal(const base::Placement& placement, const glm::vec3& world)
{
    return glm::conjugate(placement.rotation) * world;
}

} // namespace

World::World(const base::SnapshotSchema* schema, base::TaskRunner* tasks, std::pmr::memory_resource* memory,
             const Environment& environment, bool share)
    : environment_(environment), schema_(schema), tasks_(tasks), memory_(memory), share_(share),
      scratch_(memory), crowd_(memory), pools_(memory), runs_(schema, memory, share)
{}

Slot World::add(std::shared_ptr<const EffectDef> effect, const InstanceStart& start, bool hidden)
{
    const RunIndex run = runs_.enter(effect, conditionsOf(*effect, start), hidden);
    try {
        const Slot slot = takeSlot(start, run);
        if (hidden)
            hide(slot);
        return slot;
    } catch (...) {
        runs_.leave(run);
        throw;
    }
}

Slot World::takeSlot(const InstanceStart& start, RunIndex run)
{
    if (!free_.empty()) {
        const Slot slot = free_.back();
        free_.pop_back();
        instances_[slot] = {run, false, start};
        return slot;
    }
    free_.reserve(instances_.size() + 1); // remove() must not fail
    instances_.push_back({run, false, start});
    return Slot(instances_.size() - 1);
}

void World::remove(Slot slot)
{
    if (instances_[slot].hidden)
        --runs_.at(instances_[slot].run).hidden;
    runs_.leave(instances_[slot].run);
    instances_[slot] = Instance{};
    free_.push_back(slot);
}

void World::setPlacement(Slot slot, const base::Placement& placement)
{
    InstanceStart start = instances_[slot].start;
    start.placement = placement;
    change(slot, start);
}

void World::setParameters(Slot slot, const InstanceParameters& parameters)
{
    InstanceStart start = instances_[slot].start;
    start.parameters = parameters;
    change(slot, start);
}

void World::change(Slot slot, const InstanceStart& start)
{
    Instance& instance = instances_[slot];
    const RunIndex before = instance.run;
    const RunConditions wanted = conditionsOf(*runs_.at(before).effect, start);
    if (runs_.at(before).pooled && runs_.at(before).conditions.equals(wanted)) {
        instance.start = start; // it only stands elsewhere
        ++moves_;
        return;
    }
    endRest(before, now_);
    const uint32_t hiddenBefore = runs_.at(before).hidden;
    instance.run = isLagging(runs_.at(before)) ? changeLater(before, wanted) : runs_.change(before, wanted);
    instance.start = start;
    if (instance.run == before || !instance.hidden)
        return;
    runs_.at(before).hidden = runs_.at(before).users == 0 ? 0 : hiddenBefore - 1;
    ++runs_.at(instance.run).hidden;
}

/// What an instance is stepped with. It is scaled with everything its preset says, gravity included, so that
/// it keeps its look; the host's wind is that of the world outside, so it shrinks as the instance grows.
RunConditions World::conditionsOf(const EffectDef& effect, const InstanceStart& start) const
{
    RunConditions conditions;
    conditions.seed = start.seed;
    conditions.clock = start.clock.value_or(RunClock{start.startTick, effect.prewarm, start.rate});
    conditions.quality = qualityOf(start.quality);
    conditions.gravity = toLocal(start.placement, environment_.gravity);
    conditions.wind = effect.wind + toLocal(start.placement, start.parameters.wind) /
                                        std::max(start.placement.scale, 1e-6f);
    const bool hasGround = environment_.hasGround && effect.hasGround;
    conditions.groundHeight = hasGround ? 0.0f : -std::numeric_limits<float>::infinity();
    conditions.parameters = {start.parameters.intensity, glm::vec3(0.0f), start.parameters.emitting};
    if (effect.heedsPlacement()) {
        conditions.placement = start.placement;
        conditions.worldWind = start.parameters.wind;
    }
    conditions.hasContact = effect.collides() && contact_.meet;
    if (effect.collides() && (environment_.field || contact_.meet)) {
        conditions.field = environment_.field.get();
        conditions.placement = start.placement;
    }
    return conditions;
}

bool World::finished(Slot slot, base::Ticks sceneTick) const
{
    return isFinished(runs_.at(instances_[slot].run), sceneTick);
}

bool World::isFinished(const Run& run, base::Ticks sceneTick) const
{
    const base::Ticks local = run.conditions.clock.toLocal(sceneTick);
    if (local < 0 || sceneTick < run.conditions.clock.scene)
        return false;
    if (run.effect->duration > 0 && local >= run.effect->duration)
        return true;
    const auto isEmpty = [](const std::unique_ptr<Solver>& solver) { return !solver->hasElements(); };
    if (run.released)
        return false; // nobody knows before it is simulated
    if (!run.conditions.parameters.emitting && std::all_of(run.solvers.begin(), run.solvers.end(), isEmpty))
        return true;
    return std::all_of(run.solvers.begin(), run.solvers.end(),
                       [local](const std::unique_ptr<Solver>& solver) { return solver->finished(local); });
}

uint32_t World::elementCount(Slot slot) const
{
    uint32_t count = 0;
    if (const RunIndex run = instances_[slot].run; run != kNoRun)
        for (const std::unique_ptr<Solver>& solver : runs_.at(run).solvers)
            count += solver->elementCount();
    return count;
}

bool World::hasElements(Slot slot) const
{
    const auto has = [](const std::unique_ptr<Solver>& solver) { return solver->hasElements(); };
    const RunIndex run = instances_[slot].run;
    return run != kNoRun && std::any_of(runs_.at(run).solvers.begin(), runs_.at(run).solvers.end(), has);
}

const EffectDef& World::effect(Slot slot) const
{
    return *runs_.at(instances_[slot].run).effect;
}

StepCounters World::step(std::span<const Slot> active, base::Ticks tick, base::Ticks stepTicks)
{
    StepCounters counters;
    if (stepTicks <= 0)
        return counters;
    now_ = tick + stepTicks;
    resting_ = 0;
    if (active.empty())
        return counters;
    const base::FloatingPointScope floatingPoint;
    ++stepNumber_;
    crowd_.forget();
    joining_.clear();
    divideRuns(active);
    if (!mayPool_ || pools_.now() != tick || stepTicks > kLongestPoolStep)
        endPools();
    const bool isPlanned = stepPlan_.holds(active, pools_.revision());
    const std::span<const Slot> list = isPlanned ? stepPlan_.others : active;
    for (size_t k = 0; k < list.size(); ++k)
        stepSlot(list, k, tick, stepTicks, counters);
    crowd_.close();
    stepPools(active, isPlanned, counters);
    return counters;
}

void World::stepSlot(std::span<const Slot> list, size_t place, base::Ticks tick, base::Ticks stepTicks,
                     StepCounters& counters)
{
    fetchAhead(list, place);
    const RunIndex index = instances_[list[place]].run;
    Run& run = runs_.at(index);
    if (run.steppedIn == stepNumber_)
        return;
    if (run.restUntil >= now_) {
        ++resting_;
        return;
    }
    run.steppedIn = stepNumber_;
    if (run.pooled)
        return; // later, with all others
    if (run.quietUntil >= now_ && run.simulated == tick)
        return passQuietly(run, counters);
    endRest(index, tick);
    stepRun(index, tick, stepTicks, counters, &crowd_);
    if (!mayRest_)
        return;
    const base::Ticks rest = restOf(run);
    run.restUntil = rest > now_ ? rest : 0;
    run.quietUntil = quietOf(run);
    if (canPool(run))
        joining_.push_back(index);
}

/// Asks the memory for what is wanted of those that follow in a list.
void World::fetchAhead(std::span<const Slot> active, size_t place) const
{
    constexpr size_t kLine = 64;
    constexpr size_t kRunLead = 12;   // places between
    constexpr size_t kSolverLead = 6; // of which the run is known by then
    if (place + kRunLead < active.size()) {
        const Instance& instance = instances_[active[place + kRunLead]];
        const auto* run = reinterpret_cast<const char*>(&runs_.at(instance.run));
        __builtin_prefetch(run);
        __builtin_prefetch(run + kLine);
        __builtin_prefetch(reinterpret_cast<const char*>(&instance) + kLine);
    }
    if (place + kSolverLead < active.size())
        if (const Solver* const solver = runs_.at(instances_[active[place + kSolverLead]].run).only) {
            const auto* state = reinterpret_cast<const char*>(solver);
            for (size_t line = 0; line < 3; ++line)
                __builtin_prefetch(state + line * kLine);
        }
}

/// A step in which nothing happens but that time passes.
void World::passQuietly(Run& run, StepCounters& counters)
{
    const base::Ticks local = now_ + run.quietOffset;
    if (run.only)
        run.only->passTo(local, counters);
    else
        for (const std::unique_ptr<Solver>& solver : run.solvers)
            solver->passTo(local, counters);
    run.simulated = now_;
}

/// Scene time up to which steps of the run, which has been stepped, need not be taken; 0 when they must.
base::Ticks World::quietOf(Run& run) const
{
    const RunClock& clock = run.conditions.clock;
    if (clock.rate != kNormalRate || run.effect->subSteps > 1 || !run.told.empty())
        return 0;
    run.quietOffset = clock.local - clock.scene;
    const base::Ticks local = run.simulated + run.quietOffset;
    base::Ticks until = INT64_MAX / 4;
    for (const std::unique_ptr<Solver>& solver : run.solvers) {
        until = std::min(until, solver->quietUntil(local));
        if (until <= local)
            return 0;
    }
    return until - run.quietOffset;
}

/// A run of which only some users are stepped is divided into those and the others.
void World::divideRuns(std::span<const Slot> active)
{
    if (runs_.count() == instances_.size() - free_.size())
        return; // none is shared
    for (const Slot slot : active) {
        Run& run = runs_.at(instances_[slot].run);
        run.visits = run.visitedIn == stepNumber_ ? run.visits + 1 : 1;
        run.visitedIn = stepNumber_;
    }
    for (const Slot slot : active) {
        const RunIndex index = instances_[slot].run;
        if (const Run& run = runs_.at(index);
            run.dividedIn != stepNumber_ && run.visits + run.hidden == run.users)
            continue;
        RunIndex division;
        if (runs_.at(index).dividedIn != stepNumber_) {
            division = runs_.copy(index);
            runs_.at(index).dividedIn = stepNumber_;
            runs_.at(index).division = division;
            runs_.at(division).visitedIn = stepNumber_;
            runs_.at(division).visits = 1;
        } else {
            division = runs_.at(index).division;
            ++runs_.at(division).users;
            ++runs_.at(division).visits;
        }
        instances_[slot].run = division;
        runs_.leave(index);
    }
}

/// Calls body(context, run) with everything but the time filled in.
template <class F>
void World::withContext(RunIndex index, StepCounters& counters, F&& body)
{
    const Run& run = runs_.at(index);
    StepContext context{};
    context.seed = run.conditions.seed;
    context.gravity = run.conditions.gravity;
    context.wind = run.conditions.wind;
    context.groundHeight = run.conditions.groundHeight;
    std::optional<Collider> collider;
    PlacedContact contact(contact_, run.conditions.placement, contactFaults_);
    if (run.conditions.hasContact && contact_.meet) // a paused run may be at a time when there was none
        context.contactHook = &contact.hook();
    if (run.conditions.field)
        collider.emplace(*run.conditions.field, run.conditions.placement);
    context.collider = collider ? &*collider : nullptr;
    context.parameters = &run.conditions.parameters;
    context.placement = run.conditions.placement;
    context.worldGravity = environment_.gravity;
    context.worldWind = run.conditions.worldWind;
    context.effectWind = run.effect->wind;
    context.tasks = tasks_;
    context.scratch = &scratch_;
    context.counters = &counters;
    context.gpuParticles = gpuParticles_;
    body(context, run);
}

/// @param crowd null unless it is closed before anybody looks at the run
void World::stepRun(RunIndex index, base::Ticks tick, base::Ticks stepTicks, StepCounters& counters,
                    EmitterCrowd* crowd)
{
    const RunClock clock = runs_.at(index).conditions.clock;
    if (runs_.at(index).fresh && clock.local > 0)
        replay(index, 0, clock.toLocal(std::max(tick, clock.scene)), stepTicks, counters);
    withContext(index, counters, [&](StepContext& context, const Run& run) {
        const base::Ticks turns = (clock.rate + kNormalRate - 1) / kNormalRate;
        const base::Ticks parts =
            std::clamp<base::Ticks>(run.effect->subSteps, 1, 16) * std::max<base::Ticks>(turns, 1);
        context.crowd = parts == 1 ? crowd : nullptr;
        for (base::Ticks part = 0; part < parts; ++part) {
            const base::Ticks from = std::max(tick + stepTicks * part / parts, clock.scene);
            const base::Ticks to = tick + stepTicks * (part + 1) / parts;
            if (to <= from)
                continue;
            context.hostEvents = hear(index, tick);
            context.moveShare = float(double(to - from) / double(tick + stepTicks - from));
            stepLocal(index, context, run, clock.toLocal(from), clock.toLocal(to));
        }
    });
    standStill(runs_.at(index));
    runs_.at(index).simulated = std::max(tick + stepTicks, clock.scene);
}

/// Where the instance has been taken while its time stands, it did not pass through.
void World::standStill(const Run& run)
{
    if (run.conditions.clock.rate != 0)
        return;
    for (const std::unique_ptr<Solver>& solver : run.solvers)
        solver->standAt(run.conditions.placement);
}

/// One step of all solvers.
void World::stepLocal(RunIndex index, StepContext& context, const Run& run, base::Ticks from, base::Ticks to)
{
    context.tick = std::max<base::Ticks>(from, 0);
    context.stepTicks = to - context.tick;
    if (context.stepTicks <= 0)
        return;
    runs_.touch(index);
    stepSolvers(run, context);
}

/// Jumps to scene time `to`. False, and nothing has changed, when a solver cannot.
bool World::seek(RunIndex index, base::Ticks to, StepCounters& counters)
{
    const Run& run = runs_.at(index);
    const base::Ticks from = run.conditions.clock.toLocal(run.simulated);
    const base::Ticks local = run.conditions.clock.toLocal(to);
    if (local > from && !jump(index, from, local, counters))
        return false;
    runs_.at(index).simulated = std::max(to, runs_.at(index).simulated);
    return true;
}

/// The same in local time, also backwards.
bool World::jump(RunIndex index, base::Ticks from, base::Ticks to, StepCounters& counters)
{
    const Run& run = runs_.at(index);
    bool canSeek = true;
    withContext(index, counters, [&](StepContext& context, const Run&) {
        context.tick = from;
        context.stepTicks = std::max<base::Ticks>(to - from, 1);
        for (uint32_t i = 0; i < run.solvers.size() && canSeek; ++i) {
            context.solverIndex = i;
            canSeek = run.solvers[i]->canSeek(context, to);
        }
        if (!canSeek)
            return;
        runs_.touch(index);
        for (uint32_t i = 0; i < run.solvers.size(); ++i) {
            context.solverIndex = i;
            run.solvers[i]->seek(context, to);
            scratch_.reset();
        }
    });
    return canSeek;
}

void World::passOver(Slot slot, base::Ticks stepTicks)
{
    const base::FloatingPointScope floatingPoint;
    const RunIndex index = instances_[slot].run;
    if (!isLagging(runs_.at(index)))
        return;
    runs_.materialize(index);
    const base::Ticks memory = runs_.at(index).memory();
    if (memory == Run::kNever)
        return;
    const RunClock clock = runs_.at(index).conditions.clock;
    const base::Ticks local = clock.toLocal(now_) - memory;
    const base::Ticks from = local > 0 ? clock.toScene(local) / stepTicks * stepTicks : 0;
    if (from <= runs_.at(index).simulated || isFinished(runs_.at(index), runs_.at(index).simulated))
        return;
    StepCounters uncounted; // nothing is stepped
    runs_.touch(index);
    withContext(index, uncounted, [&](StepContext& context, const Run& run) {
        for (uint32_t i = 0; i < run.solvers.size(); ++i) {
            context.solverIndex = i;
            run.solvers[i]->passOver(context, clock.toLocal(from));
        }
    });
    runs_.at(index).simulated = from;
}

/// Steps from local time `from` to `to` on the schedule of an instance that is played from 0.
void World::replay(RunIndex index, base::Ticks from, base::Ticks to, base::Ticks stepTicks,
                   StepCounters& counters)
{
    if (from >= to || jump(index, from, to, counters))
        return;
    withContext(index, counters, [&](StepContext& context, const Run& run) {
        const base::Ticks parts = std::clamp<base::Ticks>(run.effect->subSteps, 1, 16);
        for (base::Ticks begin = from / stepTicks * stepTicks; begin < to; begin += stepTicks)
            for (base::Ticks part = 0; part < parts; ++part) {
                const base::Ticks first = std::max(begin + stepTicks * part / parts, from);
                stepLocal(index, context, run, first, std::min(begin + stepTicks * (part + 1) / parts, to));
            }
    });
}

void World::publish(std::span<const Slot> active, base::FrameSnapshot& snapshot) const
{
    const base::FloatingPointScope floatingPoint;
    crowd_.beginPublication(snapshot, tasks_);
    if (!pools_.empty()) {
        publishPools(active, snapshot);
    } else {
        for (size_t k = 0; k < active.size(); ++k) {
            fetchAhead(active, k);
            publishSlot(active[k], snapshot);
        }
        crowd_.endPublication();
    }
}

void World::publishSlot(Slot slot, base::FrameSnapshot& snapshot) const
{
    const Instance& instance = instances_[slot];
    const Run& run = runs_.at(instance.run);
    base::GroupInfo info;
    info.instance = instance.start.instance;
    info.placement = instance.start.placement;
    const auto publishOne = [&](const Solver& solver) {
        if (!solver.joinPublication(info, snapshot, crowd_))
            solver.publish(info, snapshot);
    };
    if (run.only)
        return publishOne(*run.only);
    for (; info.solver < run.solvers.size(); ++info.solver)
        publishOne(*run.solvers[info.solver]);
}

} // namespace fx::sim
