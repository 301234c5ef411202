// Steps of a world, which a budget of work may divide: between simulations, between sub-steps, between the
// solvers of a simulation, and inside of those that can be divided.
#include "foundation/simd/floating_point_scope.h"
#include "simulation/world/world_context.h"

#include <algorithm>

namespace fx::sim {

namespace {

constexpr uint64_t kTogetherWork = 4; // particles of pools and spawn batches that count one unit

base::Ticks partsOf(const EffectDef& effect)
{
    return std::clamp<base::Ticks>(effect.subSteps, 1, 16);
}

} // namespace

StepCounters World::step(std::span<const Slot> active, base::Ticks tick, base::Ticks stepTicks)
{
    base::WorkBudget unlimited;
    beginStep(active, tick, stepTicks);
    StepCounters counters;
    proceed(unlimited, counters);
    return counters;
}

void World::beginStep(std::span<const Slot> active, base::Ticks tick, base::Ticks stepTicks)
{
    if (stepTicks <= 0)
        return;
    now_ = tick + stepTicks;
    resting_ = 0;
    if (active.empty())
        return;
    const base::FloatingPointScope floatingPoint;
    ++stepNumber_;
    spawnBatch_.forget();
    joining_.clear();
    cueOrders_ = 0;
    if (cues_)
        cues_->clear();
    divideSimulations(active);
    if (!mayPool_ || pools_.now() != tick || stepTicks > kLongestPoolStep)
        endPools();
    hand_.isPlanned = stepPlan_.holds(active, pools_.revision());
    hand_.active = active;
    hand_.list = hand_.isPlanned ? stepPlan_.others : active;
    hand_.place = 0;
    hand_.tick = tick;
    hand_.stepTicks = stepTicks;
    hand_.counters = {};
    hand_.board.reset();
    hand_.isOpen = true;
}

bool World::proceed(base::WorkBudget& work, StepCounters& counters)
{
    if (!hand_.isOpen)
        return true;
    const base::FloatingPointScope floatingPoint;
    struct Ending // also after an exception, which ends the step
    {
        World& world;
        bool goesOn = false;
        ~Ending()
        {
            if (!goesOn)
                world.dropStep();
        }
    } ending{*this};
    for (; hand_.place < hand_.list.size(); ++hand_.place)
        if (work.isSpent() || !stepSlot(work)) {
            keepStep();
            ending.goesOn = true;
            return false;
        }
    const StepCounters before = hand_.counters;
    spawnBatch_.close();
    stepPools(hand_.active, hand_.isPlanned, hand_.counters);
    const StepCounters together = hand_.counters.since(before);
    work.spend(together.particleSteps / kTogetherWork + together.born - together.dropped);
    counters += hand_.counters;
    counters += closed_;
    closed_ = {};
    return true;
}

/// The step goes on in another call, when the lists that it was given may be gone.
void World::keepStep()
{
    if (hand_.active.data() == hand_.ownActive.data())
        return;
    const bool isPart = hand_.list.data() != hand_.active.data();
    hand_.ownActive.assign(hand_.active.begin(), hand_.active.end());
    hand_.active = hand_.ownActive;
    if (isPart)
        hand_.ownList.assign(hand_.list.begin(), hand_.list.end());
    hand_.list = isPart ? std::span<const Slot>(hand_.ownList) : hand_.active;
}

/// Nothing of the step is in hand any more, whether it is complete or not.
void World::dropStep()
{
    if (!hand_.isOpen)
        return;
    hand_.isOpen = false;
    hand_.board.reset();
    if (hand_.place < hand_.list.size()) {
        SharedSimulation& simulation = simulations_.at(instances_[hand_.list[hand_.place]].simulation);
        simulation.inStep = simulation.inPart = false;
    }
    hand_.active = hand_.list = {};
}

bool World::stepSlot(base::WorkBudget& work)
{
    const SimulationIndex index = instances_[hand_.list[hand_.place]].simulation;
    SharedSimulation& simulation = simulations_.at(index);
    if (!simulation.inStep && !simulation.arriving) {
        fetchAhead(hand_.list, hand_.place);
        if (simulation.steppedIn == stepNumber_)
            return true;
        if (simulation.restUntil >= now_) {
            ++resting_;
            return true;
        }
        simulation.steppedIn = stepNumber_;
        if (simulation.pooled)
            return true; // later, with all others
        if (simulation.quietUntil >= now_ && simulation.simulated == hand_.tick) {
            passQuietly(simulation, hand_.counters);
            return true;
        }
        endRest(index, hand_.tick);
    }
    if (!stepSimulation(index, {hand_.tick, hand_.stepTicks, &spawnBatch_, &hand_.board}, work,
                        hand_.counters))
        return false;
    if (!mayRest_)
        return true;
    const base::Ticks rest = restOf(simulation);
    simulation.restUntil = rest > now_ ? rest : 0;
    simulation.quietUntil = quietOf(simulation);
    if (canPool(simulation))
        joining_.push_back(index);
    return true;
}

/// Goes on with the simulation's step in hand, or begins one.
/// @return whether it is complete
bool World::stepSimulation(SimulationIndex index, const SimulationStep& step, base::WorkBudget& work,
                           StepCounters& counters)
{
    if (!simulations_.at(index).inStep) {
        if (!arrive(index, step.tick, step.stepTicks, work, counters))
            return false;
        SharedSimulation& simulation = simulations_.at(index);
        simulation.inStep = true;
        simulation.part = 0;
        simulation.stepTick = step.tick;
        simulation.stepLength = step.stepTicks;
    }
    bool isComplete = true;
    withContext(index, counters, [&](StepContext& context, SharedSimulation& simulation) {
        const InstanceClock& clock = simulation.conditions.clock;
        const base::Ticks turns = (clock.rate + kNormalRate - 1) / kNormalRate;
        const base::Ticks parts = partsOf(*simulation.effect) * std::max<base::Ticks>(turns, 1);
        context.spawnBatch = parts == 1 ? step.spawnBatch : nullptr;
        if (cues_ && step.board && !rehearses_ && !simulation.effect->order.empty()) {
            selectCues(simulation); // a simulation that catches up records no events
            context.cues = &*cues_;
        }
        LinkedPart* const own = step.board ? nullptr : linkedPartOf(simulation);
        std::optional<EventBoard> none; // of solvers without events
        std::optional<EventBoard>& board = own ? own->board : step.board ? *step.board : none;
        std::span<const HostEvent>& hostEvents = own ? own->hostEvents : hand_.hostEvents;
        if (own)
            context.scratch = &own->scratch;
        for (; simulation.part < parts; ++simulation.part) {
            const base::Ticks from =
                std::max(step.tick + step.stepTicks * simulation.part / parts, clock.scene);
            const base::Ticks to = step.tick + step.stepTicks * (simulation.part + 1) / parts;
            if (to <= from)
                continue;
            if (!simulation.inPart) {
                if (simulation.part > 0 && work.isSpent()) {
                    isComplete = false;
                    return;
                }
                hostEvents = takeEvents(index, step.tick, *context.scratch);
            }
            context.hostEvents = hostEvents;
            context.moveShare = float(double(to - from) / double(step.tick + step.stepTicks - from));
            isComplete = stepPart(index, context, {clock.toLocal(from), clock.toLocal(to)}, board, work);
            if (!isComplete)
                return;
        }
    });
    if (!isComplete)
        return false;
    SharedSimulation& simulation = simulations_.at(index);
    simulation.inStep = false;
    standStill(simulation);
    simulation.simulated = std::max(step.tick + step.stepTicks, simulation.conditions.clock.scene);
    return true;
}

/// Where the instance has been taken while its time stands, it did not pass through.
void World::standStill(const SharedSimulation& simulation)
{
    if (simulation.conditions.clock.rate != 0)
        return;
    for (const std::unique_ptr<Solver>& solver : simulation.solvers)
        if (SeekableSolver* const seekable = solver->seekable())
            seekable->standAt(simulation.conditions.placement);
}

/// One sub-step of all solvers, or the rest of the one in hand.
/// @param ioBoard see stepSolvers()
bool World::stepPart(SimulationIndex index, StepContext& context, const LocalSpan& time,
                     std::optional<EventBoard>& ioBoard, base::WorkBudget& work)
{
    context.tick = std::max<base::Ticks>(time.begin, 0);
    context.stepTicks = time.end - context.tick;
    if (context.stepTicks <= 0)
        return true;
    SharedSimulation& simulation = simulations_.at(index);
    if (!simulation.inPart) {
        simulations_.touch(index);
        simulation.inPart = true;
        simulation.stepped = 0;
    }
    if (!stepSolvers(simulation, context, ioBoard, work))
        return false;
    simulation.inPart = false;
    return true;
}

/// Takes a simulation that begins with a past, prewarm, through it.
/// @param tick scene time at which its first step begins @return whether it is there
bool World::arrive(SimulationIndex index, base::Ticks tick, base::Ticks stepTicks, base::WorkBudget& work,
                   StepCounters& counters)
{
    const SharedSimulation& simulation = simulations_.at(index);
    const InstanceClock& clock = simulation.conditions.clock;
    if (!simulation.arriving && simulation.fresh && clock.local > 0)
        setOut(index, {0, clock.toLocal(std::max(tick, clock.scene))}, stepTicks, counters);
    return !simulation.arriving || replay(index, work, counters);
}

/// The state is at the begin of `way` and is to be at its end: it jumps there, or replay() takes it.
void World::setOut(SimulationIndex index, const LocalSpan& way, base::Ticks stepTicks, StepCounters& counters)
{
    if (way.begin >= way.end || jump(index, way.begin, way.end, counters))
        return;
    simulations_.touch(index); // no instance may join it meanwhile
    SharedSimulation& simulation = simulations_.at(index);
    simulation.arriving = true;
    simulation.reached = way.begin;
    simulation.target = way.end;
    simulation.stepLength = stepTicks;
}

/// Steps on the schedule of an instance that is played from 0, as far as the work goes.
bool World::replay(SimulationIndex index, base::WorkBudget& work, StepCounters& counters)
{
    const base::FloatingPointScope floatingPoint;
    SharedSimulation& simulation = simulations_.at(index);
    while (simulation.reached < simulation.target) {
        if ((work.isSpent() && !simulation.inPart) || !replayPart(index, work, counters))
            return false;
    }
    simulation.arriving = false;
    simulation.linked.reset();
    return true;
}

/// One sub-step of that schedule, or the rest of the one in hand.
bool World::replayPart(SimulationIndex index, base::WorkBudget& work, StepCounters& counters)
{
    bool isComplete = true;
    withContext(index, counters, [&](StepContext& context, SharedSimulation& simulation) {
        const base::Ticks parts = partsOf(*simulation.effect);
        const base::Ticks begin = simulation.reached / simulation.stepLength * simulation.stepLength;
        base::Ticks part = 1;
        while (begin + simulation.stepLength * part / parts <= simulation.reached)
            ++part;
        const base::Ticks end = std::min(begin + simulation.stepLength * part / parts, simulation.target);
        LinkedPart* const own = linkedPartOf(simulation);
        std::optional<EventBoard> none; // of solvers without events
        if (own)
            context.scratch = &own->scratch;
        isComplete = stepPart(index, context, {simulation.reached, end}, own ? own->board : none, work);
        if (isComplete)
            simulation.reached = end;
    });
    return isComplete;
}

/// Ends what is in hand of a simulation that is not stepped with the others, so that its state can be copied.
void World::closeSimulation(SimulationIndex index)
{
    const SharedSimulation& simulation = simulations_.at(index);
    base::WorkBudget unlimited;
    if (simulation.arriving && simulation.inPart)
        replayPart(index, unlimited, closed_);
    else if (simulation.inStep)
        stepSimulation(index, {simulation.stepTick, simulation.stepLength}, unlimited, closed_);
}

} // namespace fx::sim
