#include "simulation/world/world.h"

#include "foundation/simd/floating_point_scope.h"
#include "simulation/world/world_context.h"

#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <limits>
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
        instances_[slot] = {run, false, 0, start};
        return slot;
    }
    free_.reserve(instances_.size() + 1); // remove() must not fail
    leaving_.reserve(instances_.size() + 1);
    instances_.push_back({run, false, 0, start});
    return Slot(instances_.size() - 1);
}

void World::remove(Slot slot)
{
    if (isStepping())
        return leaving_.push_back(slot); // has room
    if (instances_[slot].hidden)
        --runs_.at(instances_[slot].run).hidden;
    runs_.leave(instances_[slot].run);
    instances_[slot] = Instance{};
    free_.push_back(slot);
}

void World::setPlacement(Slot slot, const base::Placement& placement)
{
    InstanceStart start = wantedOf(slot);
    start.placement = placement;
    change(slot, start);
}

void World::setParameters(Slot slot, const InstanceParameters& parameters)
{
    InstanceStart start = wantedOf(slot);
    start.parameters = parameters;
    change(slot, start);
}

void World::change(Slot slot, const InstanceStart& start)
{
    if (isStepping())
        return changeAfterStep(slot, start);
    Instance& instance = instances_[slot];
    const RunIndex before = instance.run;
    const RunConditions wanted = conditionsOf(*runs_.at(before).effect, start);
    if (runs_.at(before).pooled && runs_.at(before).conditions.equals(wanted)) {
        instance.start = start; // it only stands elsewhere
        ++moves_;
        return;
    }
    endRest(before, now_);
    if (runs_.at(before).users > 1 || !isLagging(runs_.at(before))) // otherwise it hears of it later
        closeRun(before);
    const uint32_t hiddenBefore = runs_.at(before).hidden;
    instance.run = isLagging(runs_.at(before)) ? changeLater(before, wanted) : runs_.change(before, wanted);
    instance.start = start;
    if (instance.run == before || !instance.hidden)
        return;
    runs_.at(before).hidden = runs_.at(before).users == 0 ? 0 : hiddenBefore - 1;
    ++runs_.at(instance.run).hidden;
}

void World::changeAfterStep(Slot slot, const InstanceStart& start)
{
    Instance& instance = instances_[slot];
    if (instance.wanted > 0) {
        wanted_[instance.wanted - 1] = start;
        return;
    }
    wanted_.push_back(start);
    waiting_.push_back({slot, std::nullopt}); // if that throws, the other is unchanged
    instance.wanted = uint32_t(wanted_.size());
}

void World::makeChanges()
{
    size_t made = 0;
    struct Forgetting // those that were made
    {
        std::vector<Waiting>& waiting;
        size_t& made;
        ~Forgetting() { waiting.erase(waiting.begin(), waiting.begin() + ptrdiff_t(made)); }
    } forgetting{waiting_, made};
    for (; made < waiting_.size(); ++made) {
        const Waiting& next = waiting_[made];
        if (instances_[next.slot].run == kNoRun)
            continue; // it has ended with the step
        if (next.event) {
            tell(next.slot, *next.event);
            continue;
        }
        change(next.slot, wantedOf(next.slot));
        instances_[next.slot].wanted = 0;
    }
    wanted_.clear();
    for (; !leaving_.empty(); leaving_.pop_back())
        remove(leaving_.back());
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
        return false; // unknown before it is simulated
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

/// Prefetches data of the following elements of a list.
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
        run.only->seekable()->passTo(local, counters);
    else
        for (const std::unique_ptr<Solver>& solver : run.solvers)
            solver->seekable()->passTo(local, counters);
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
        const SeekableSolver* const seekable = solver->seekable();
        until = seekable ? std::min(until, seekable->quietUntil(local)) : local;
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
            const SeekableSolver* const seekable = run.solvers[i]->seekable();
            canSeek = seekable && seekable->canSeek(context, to);
        }
        if (!canSeek)
            return;
        runs_.touch(index);
        for (uint32_t i = 0; i < run.solvers.size(); ++i) {
            context.solverIndex = i;
            run.solvers[i]->seekable()->seek(context, to);
            scratch_.reset();
        }
    });
    return canSeek;
}

void World::passOver(Slot slot, base::Ticks stepTicks)
{
    const base::FloatingPointScope floatingPoint;
    const RunIndex index = instances_[slot].run;
    if (!isLagging(runs_.at(index)) || runs_.at(index).arriving || runs_.at(index).inStep)
        return;
    runs_.materialize(index);
    const base::Ticks horizon = runs_.at(index).influenceHorizon();
    if (horizon == Run::kNever)
        return;
    const RunClock clock = runs_.at(index).conditions.clock;
    const base::Ticks local = clock.toLocal(now_) - horizon;
    const base::Ticks from = local > 0 ? clock.toScene(local) / stepTicks * stepTicks : 0;
    if (from <= runs_.at(index).simulated || isFinished(runs_.at(index), runs_.at(index).simulated))
        return;
    StepCounters uncounted; // nothing is stepped
    runs_.touch(index);
    withContext(index, uncounted, [&](StepContext& context, const Run& run) {
        for (uint32_t i = 0; i < run.solvers.size(); ++i) {
            context.solverIndex = i;
            run.solvers[i]->finiteMemory()->passOver(context, clock.toLocal(from));
        }
    });
    runs_.at(index).simulated = from;
}

} // namespace fx::sim
