#include "simulation/world/world.h"

#include "foundation/simd/floating_point_scope.h"
#include "simulation/world/world_context.h"

#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <limits>
#include <new>
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
      scratch_(memory), spawnBatch_(memory), pools_(memory), simulations_(schema, memory, share)
{}

Slot World::add(std::shared_ptr<const EffectDef> effect, const InstanceStart& start, bool hidden)
{
    const SimulationIndex simulation = simulations_.acquire(effect, conditionsOf(*effect, start), hidden);
    try {
        const Slot slot = takeSlot(start, simulation);
        if (hidden)
            hide(slot);
        else if (effect->startsInMotion())
            standBeforeStart(simulation);
        return slot;
    } catch (...) {
        simulations_.leave(simulation);
        throw;
    }
}

/// Moves the solvers of an instance that starts within a step to the begin of that step, where their elements
/// are published as well.
void World::standBeforeStart(SimulationIndex index)
{
    const base::Ticks local = simulations_.at(index).conditions.clock.toLocal(now_);
    if (local >= 0)
        return;
    StepCounters uncounted;
    withContext(index, uncounted, [&](StepContext& context, const SharedSimulation& simulation) {
        for (uint32_t i = 0; i < simulation.solvers.size(); ++i) {
            context.solverIndex = i;
            if (simulation.effect->solvers[i]->startsInMotion())
                simulation.solvers[i]->seekable()->seek(context, local);
        }
    });
}

void World::rehearse(const std::shared_ptr<const EffectDef>& effect, QualityLevel level)
{
    constexpr int kSteps = 30;
    constexpr uint64_t kWork = 2'000'000; // about 20 ms
    const base::FloatingPointScope floatingPoint;
    const base::Ticks length = base::kTicksPerSecond / 60;
    InstanceStart start;
    start.quality = level;
    start.startTick = now_;
    SimulationConditions conditions = conditionsOf(*effect, start);
    conditions.hasContact = false; // the host is not asked
    conditions.field = nullptr;
    spawnBatch_.reserve();
    struct Ending
    {
        World& world;
        SimulationIndex index;
        ~Ending()
        {
            world.rehearses_ = false;
            world.spawnBatch_.forget();
            world.simulations_.leave(index);
            try {
                world.scratch_.reset();
            } catch (const std::bad_alloc&) {
                // it is empty, and grows with the next step
            }
        }
    } ending{*this, simulations_.create(effect, conditions)};
    rehearses_ = true;
    base::WorkBudget work(kWork);
    StepCounters uncounted;
    for (int i = 0; i < kSteps && !work.isSpent(); ++i) {
        std::optional<EventBoard> board;
        const SimulationStep step{now_ + i * length, length, &spawnBatch_, &board};
        if (!stepSimulation(ending.index, step, work, uncounted))
            break;
        spawnBatch_.close();
        scratch_.reset();
    }
}

Slot World::takeSlot(const InstanceStart& start, SimulationIndex simulation)
{
    if (!free_.empty()) {
        const Slot slot = free_.back();
        free_.pop_back();
        instances_[slot] = {simulation, false, 0, start};
        return slot;
    }
    free_.reserve(instances_.size() + 1); // remove() must not fail
    leaving_.reserve(instances_.size() + 1);
    instances_.push_back({simulation, false, 0, start});
    return Slot(instances_.size() - 1);
}

void World::remove(Slot slot)
{
    if (isStepping())
        return leaving_.push_back(slot); // has room
    if (instances_[slot].hidden)
        --simulations_.at(instances_[slot].simulation).hidden;
    simulations_.leave(instances_[slot].simulation);
    instances_[slot] = Instance{};
    free_.push_back(slot);
}

uint32_t World::reserve(const std::shared_ptr<const EffectDef>& effect, QualityLevel level, uint32_t count)
{
    if (count > 0)
        reserveSlots(instances_.size() + simulations_.idleAfter(*effect, level, count));
    const uint32_t made = simulations_.reserve(effect, level, count);
    for (SimulationIndex index = 0; index < simulations_.size(); ++index)
        if (simulations_.isReserved(index))
            leavePool(index);
    return made;
}

/// Reserves memory in all lists of instances.
void World::reserveSlots(size_t slots)
{
    instances_.reserve(slots);
    free_.reserve(slots);
    leaving_.reserve(slots);
    waiting_.reserve(slots);
    wanted_.reserve(slots);
    for (std::vector<Slot>* const list :
         {&stepPlan_.active, &stepPlan_.others, &publishPlan_.active, &publishPlan_.others, &hand_.ownActive,
          &hand_.ownList, &publication_.own})
        list->reserve(slots);
    joining_.reserve(slots);
    ends_.reserve(slots);
}

void World::reserveSwap(World& other)
{
    const size_t more = simulations_.reservedSets();
    if (more == 0)
        return;
    const size_t slots = other.instances_.size() + more;
    other.reserveSlots(slots);
    other.simulations_.reserveEntries(more);
    reserveSlots(slots);
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
    const SimulationIndex before = instance.simulation;
    const SimulationConditions wanted = conditionsOf(*simulations_.at(before).effect, start);
    if (simulations_.at(before).pooled && simulations_.at(before).conditions.equals(wanted)) {
        instance.start = start; // it only stands elsewhere
        ++moves_;
        return;
    }
    endRest(before, now_);
    if (simulations_.at(before).users > 1 ||
        !isLagging(simulations_.at(before))) // otherwise it hears of it later
        closeSimulation(before);
    const uint32_t hiddenBefore = simulations_.at(before).hidden;
    instance.simulation = isLagging(simulations_.at(before)) ? changeLater(before, wanted)
                                                             : simulations_.change(before, wanted);
    instance.start = start;
    if (instance.simulation == before || !instance.hidden)
        return;
    simulations_.at(before).hidden = simulations_.at(before).users == 0 ? 0 : hiddenBefore - 1;
    ++simulations_.at(instance.simulation).hidden;
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
        if (instances_[next.slot].simulation == kNoSimulation)
            continue; // it has ended with the step
        if (next.event) {
            postEvent(next.slot, *next.event);
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
SimulationConditions World::conditionsOf(const EffectDef& effect, const InstanceStart& start) const
{
    SimulationConditions conditions;
    conditions.seed = start.seed;
    conditions.clock = start.clock.value_or(InstanceClock{start.startTick, effect.prewarm, start.rate});
    conditions.quality = qualityOf(start.quality);
    conditions.gravity = toLocal(start.placement, environment_.gravity);
    conditions.wind = effect.wind + toLocal(start.placement, start.parameters.wind) /
                                        std::max(start.placement.scale, 1e-6f);
    const bool hasGround = environment_.hasGround && effect.hasGround;
    conditions.groundHeight = hasGround ? 0.0f : -std::numeric_limits<float>::infinity();
    conditions.parameters = {start.parameters.intensity, glm::vec3(0.0f), start.parameters.emitting,
                             start.parameters.tint};
    if (effect.dependsOnPlacement()) {
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
    return isFinished(simulations_.at(instances_[slot].simulation), sceneTick);
}

bool World::isFinished(const SharedSimulation& simulation, base::Ticks sceneTick) const
{
    const base::Ticks local = simulation.conditions.clock.toLocal(sceneTick);
    if (local < 0 || sceneTick < simulation.conditions.clock.scene)
        return false;
    if (simulation.effect->duration > 0 && local >= simulation.effect->duration)
        return true;
    const auto isEmpty = [](const std::unique_ptr<Solver>& solver) { return !solver->hasElements(); };
    if (simulation.released)
        return false; // unknown before it is simulated
    if (!simulation.conditions.parameters.emitting &&
        std::all_of(simulation.solvers.begin(), simulation.solvers.end(), isEmpty))
        return true;
    return std::all_of(simulation.solvers.begin(), simulation.solvers.end(),
                       [local](const std::unique_ptr<Solver>& solver) { return solver->finished(local); });
}

uint32_t World::elementCount(Slot slot) const
{
    uint32_t count = 0;
    if (const SimulationIndex simulation = instances_[slot].simulation; simulation != kNoSimulation)
        for (const std::unique_ptr<Solver>& solver : simulations_.at(simulation).solvers)
            count += solver->elementCount();
    return count;
}

bool World::hasElements(Slot slot) const
{
    const auto has = [](const std::unique_ptr<Solver>& solver) { return solver->hasElements(); };
    const SimulationIndex simulation = instances_[slot].simulation;
    return simulation != kNoSimulation && std::any_of(simulations_.at(simulation).solvers.begin(),
                                                      simulations_.at(simulation).solvers.end(), has);
}

const EffectDef& World::effect(Slot slot) const
{
    return *simulations_.at(instances_[slot].simulation).effect;
}

/// Prefetches data of the following elements of a list.
void World::fetchAhead(std::span<const Slot> active, size_t place) const
{
    constexpr size_t kLine = 64;
    constexpr size_t kRunLead = 12;   // places between
    constexpr size_t kSolverLead = 6; // of which the simulation is known by then
    if (place + kRunLead < active.size()) {
        const Instance& instance = instances_[active[place + kRunLead]];
        const auto* simulation = reinterpret_cast<const char*>(&simulations_.at(instance.simulation));
        __builtin_prefetch(simulation);
        __builtin_prefetch(simulation + kLine);
        __builtin_prefetch(reinterpret_cast<const char*>(&instance) + kLine);
    }
    if (place + kSolverLead < active.size())
        if (const Solver* const solver =
                simulations_.at(instances_[active[place + kSolverLead]].simulation).only) {
            const auto* state = reinterpret_cast<const char*>(solver);
            for (size_t line = 0; line < 3; ++line)
                __builtin_prefetch(state + line * kLine);
        }
}

/// A step in which nothing happens but that time passes.
void World::passQuietly(SharedSimulation& simulation, StepCounters& counters)
{
    const base::Ticks local = now_ + simulation.quietOffset;
    if (simulation.only)
        simulation.only->seekable()->passTo(local, counters);
    else
        for (const std::unique_ptr<Solver>& solver : simulation.solvers)
            solver->seekable()->passTo(local, counters);
    simulation.simulated = now_;
}

/// Scene time up to which steps of the simulation, which has been stepped, need not be taken; 0 when they
/// must.
base::Ticks World::quietOf(SharedSimulation& simulation) const
{
    const InstanceClock& clock = simulation.conditions.clock;
    if (clock.rate != kNormalRate || simulation.effect->subSteps > 1 || !simulation.pendingEvents.empty())
        return 0;
    simulation.quietOffset = clock.local - clock.scene;
    const base::Ticks local = simulation.simulated + simulation.quietOffset;
    base::Ticks until = INT64_MAX / 4;
    for (const std::unique_ptr<Solver>& solver : simulation.solvers) {
        const SeekableSolver* const seekable = solver->seekable();
        until = seekable ? std::min(until, seekable->quietUntil(local)) : local;
        if (until <= local)
            return 0;
    }
    return until - simulation.quietOffset;
}

/// A simulation of which only some users are stepped is divided into those and the others.
void World::divideSimulations(std::span<const Slot> active)
{
    if (simulations_.count() == instances_.size() - free_.size())
        return; // none is shared
    for (const Slot slot : active) {
        SharedSimulation& simulation = simulations_.at(instances_[slot].simulation);
        simulation.visits = simulation.visitedIn == stepNumber_ ? simulation.visits + 1 : 1;
        simulation.visitedIn = stepNumber_;
    }
    for (const Slot slot : active) {
        const SimulationIndex index = instances_[slot].simulation;
        if (const SharedSimulation& simulation = simulations_.at(index);
            simulation.dividedIn != stepNumber_ && simulation.visits + simulation.hidden == simulation.users)
            continue;
        SimulationIndex division;
        if (simulations_.at(index).dividedIn != stepNumber_) {
            division = simulations_.copy(index);
            simulations_.at(index).dividedIn = stepNumber_;
            simulations_.at(index).division = division;
            simulations_.at(division).visitedIn = stepNumber_;
            simulations_.at(division).visits = 1;
        } else {
            division = simulations_.at(index).division;
            ++simulations_.at(division).users;
            ++simulations_.at(division).visits;
        }
        instances_[slot].simulation = division;
        simulations_.leave(index);
    }
}

/// Jumps to scene time `to`. False, and nothing has changed, when a solver cannot.
bool World::seek(SimulationIndex index, base::Ticks to, StepCounters& counters)
{
    const SharedSimulation& simulation = simulations_.at(index);
    const base::Ticks from = simulation.conditions.clock.toLocal(simulation.simulated);
    const base::Ticks local = simulation.conditions.clock.toLocal(to);
    if (local > from && !jump(index, from, local, counters))
        return false;
    simulations_.at(index).simulated = std::max(to, simulations_.at(index).simulated);
    return true;
}

/// The same in local time, also backwards.
bool World::jump(SimulationIndex index, base::Ticks from, base::Ticks to, StepCounters& counters)
{
    const SharedSimulation& simulation = simulations_.at(index);
    bool canSeek = true;
    withContext(index, counters, [&](StepContext& context, const SharedSimulation&) {
        context.tick = from;
        context.stepTicks = std::max<base::Ticks>(to - from, 1);
        for (uint32_t i = 0; i < simulation.solvers.size() && canSeek; ++i) {
            context.solverIndex = i;
            const SeekableSolver* const seekable = simulation.solvers[i]->seekable();
            canSeek = seekable && seekable->canSeek(context, to);
        }
        if (!canSeek)
            return;
        simulations_.touch(index);
        for (uint32_t i = 0; i < simulation.solvers.size(); ++i) {
            context.solverIndex = i;
            simulation.solvers[i]->seekable()->seek(context, to);
            scratch_.reset();
        }
    });
    return canSeek;
}

void World::passOver(Slot slot, base::Ticks stepTicks)
{
    const base::FloatingPointScope floatingPoint;
    const SimulationIndex index = instances_[slot].simulation;
    if (!isLagging(simulations_.at(index)) || simulations_.at(index).arriving ||
        simulations_.at(index).inStep)
        return;
    simulations_.materialize(index);
    const base::Ticks horizon = simulations_.at(index).influenceHorizon();
    if (horizon == SharedSimulation::kNever)
        return;
    const InstanceClock clock = simulations_.at(index).conditions.clock;
    const base::Ticks local = clock.toLocal(now_) - horizon;
    const base::Ticks from = local > 0 ? clock.toScene(local) / stepTicks * stepTicks : 0;
    if (from <= simulations_.at(index).simulated ||
        isFinished(simulations_.at(index), simulations_.at(index).simulated))
        return;
    StepCounters uncounted; // nothing is stepped
    simulations_.touch(index);
    withContext(index, uncounted, [&](StepContext& context, const SharedSimulation& simulation) {
        for (uint32_t i = 0; i < simulation.solvers.size(); ++i) {
            context.solverIndex = i;
            simulation.solvers[i]->finiteMemory()->passOver(context, clock.toLocal(from));
        }
    });
    simulations_.at(index).simulated = from;
}

} // namespace fx::sim
