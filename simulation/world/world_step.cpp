// Steps of a world, which a budget of work may divide: between runs, between sub-steps, between the solvers
// of a run, and inside of those that can be divided.
#include "foundation/simd/floating_point_scope.h"
#include "simulation/world/world_context.h"

#include <algorithm>

namespace fx::sim {

namespace {

constexpr uint64_t kTogetherWork = 4; // particles of pools and crowds that count one unit

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
    crowd_.forget();
    joining_.clear();
    divideRuns(active);
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
    crowd_.close();
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
        Run& run = runs_.at(instances_[hand_.list[hand_.place]].run);
        run.inStep = run.inPart = false;
    }
    hand_.active = hand_.list = {};
}

bool World::stepSlot(base::WorkBudget& work)
{
    const RunIndex index = instances_[hand_.list[hand_.place]].run;
    Run& run = runs_.at(index);
    if (!run.inStep && !run.arriving) {
        fetchAhead(hand_.list, hand_.place);
        if (run.steppedIn == stepNumber_)
            return true;
        if (run.restUntil >= now_) {
            ++resting_;
            return true;
        }
        run.steppedIn = stepNumber_;
        if (run.pooled)
            return true; // later, with all others
        if (run.quietUntil >= now_ && run.simulated == hand_.tick) {
            passQuietly(run, hand_.counters);
            return true;
        }
        endRest(index, hand_.tick);
    }
    if (!stepRun(index, {hand_.tick, hand_.stepTicks, &crowd_, &hand_.board}, work, hand_.counters))
        return false;
    if (!mayRest_)
        return true;
    const base::Ticks rest = restOf(run);
    run.restUntil = rest > now_ ? rest : 0;
    run.quietUntil = quietOf(run);
    if (canPool(run))
        joining_.push_back(index);
    return true;
}

/// Goes on with the run's step in hand, or begins one.
/// @return whether it is complete
bool World::stepRun(RunIndex index, const RunStep& step, base::WorkBudget& work, StepCounters& counters)
{
    if (!runs_.at(index).inStep) {
        if (!arrive(index, step.tick, step.stepTicks, work, counters))
            return false;
        Run& run = runs_.at(index);
        run.inStep = true;
        run.part = 0;
        run.stepTick = step.tick;
        run.stepLength = step.stepTicks;
    }
    bool isComplete = true;
    withContext(index, counters, [&](StepContext& context, Run& run) {
        const RunClock& clock = run.conditions.clock;
        const base::Ticks turns = (clock.rate + kNormalRate - 1) / kNormalRate;
        const base::Ticks parts = partsOf(*run.effect) * std::max<base::Ticks>(turns, 1);
        context.crowd = parts == 1 ? step.crowd : nullptr;
        LinkedPart* const own = step.board ? nullptr : linkedPartOf(run);
        std::optional<EventBoard> none; // of solvers without events
        std::optional<EventBoard>& board = own ? own->board : step.board ? *step.board : none;
        std::span<const HostEvent>& heard = own ? own->heard : hand_.heard;
        if (own)
            context.scratch = &own->scratch;
        for (; run.part < parts; ++run.part) {
            const base::Ticks from = std::max(step.tick + step.stepTicks * run.part / parts, clock.scene);
            const base::Ticks to = step.tick + step.stepTicks * (run.part + 1) / parts;
            if (to <= from)
                continue;
            if (!run.inPart) {
                if (run.part > 0 && work.isSpent()) {
                    isComplete = false;
                    return;
                }
                heard = hear(index, step.tick, *context.scratch);
            }
            context.hostEvents = heard;
            context.moveShare = float(double(to - from) / double(step.tick + step.stepTicks - from));
            isComplete = stepPart(index, context, {clock.toLocal(from), clock.toLocal(to)}, board, work);
            if (!isComplete)
                return;
        }
    });
    if (!isComplete)
        return false;
    Run& run = runs_.at(index);
    run.inStep = false;
    standStill(run);
    run.simulated = std::max(step.tick + step.stepTicks, run.conditions.clock.scene);
    return true;
}

/// Where the instance has been taken while its time stands, it did not pass through.
void World::standStill(const Run& run)
{
    if (run.conditions.clock.rate != 0)
        return;
    for (const std::unique_ptr<Solver>& solver : run.solvers)
        if (SeekableSolver* const seekable = solver->seekable())
            seekable->standAt(run.conditions.placement);
}

/// One sub-step of all solvers, or the rest of the one in hand.
/// @param ioBoard see stepSolvers()
bool World::stepPart(RunIndex index, StepContext& context, const LocalSpan& time,
                     std::optional<EventBoard>& ioBoard, base::WorkBudget& work)
{
    context.tick = std::max<base::Ticks>(time.begin, 0);
    context.stepTicks = time.end - context.tick;
    if (context.stepTicks <= 0)
        return true;
    Run& run = runs_.at(index);
    if (!run.inPart) {
        runs_.touch(index);
        run.inPart = true;
        run.stepped = 0;
    }
    if (!stepSolvers(run, context, ioBoard, work))
        return false;
    run.inPart = false;
    return true;
}

/// Takes a run that begins with a past, prewarm, through it.
/// @param tick scene time at which its first step begins @return whether it is there
bool World::arrive(RunIndex index, base::Ticks tick, base::Ticks stepTicks, base::WorkBudget& work,
                   StepCounters& counters)
{
    const Run& run = runs_.at(index);
    const RunClock& clock = run.conditions.clock;
    if (!run.arriving && run.fresh && clock.local > 0)
        setOut(index, {0, clock.toLocal(std::max(tick, clock.scene))}, stepTicks, counters);
    return !run.arriving || replay(index, work, counters);
}

/// The state is at the begin of `way` and is to be at its end: it jumps there, or replay() takes it.
void World::setOut(RunIndex index, const LocalSpan& way, base::Ticks stepTicks, StepCounters& counters)
{
    if (way.begin >= way.end || jump(index, way.begin, way.end, counters))
        return;
    runs_.touch(index); // no instance may join it meanwhile
    Run& run = runs_.at(index);
    run.arriving = true;
    run.reached = way.begin;
    run.target = way.end;
    run.stepLength = stepTicks;
}

/// Steps on the schedule of an instance that is played from 0, as far as the work goes.
bool World::replay(RunIndex index, base::WorkBudget& work, StepCounters& counters)
{
    const base::FloatingPointScope floatingPoint;
    Run& run = runs_.at(index);
    while (run.reached < run.target) {
        if ((work.isSpent() && !run.inPart) || !replayPart(index, work, counters))
            return false;
    }
    run.arriving = false;
    run.linked.reset();
    return true;
}

/// One sub-step of that schedule, or the rest of the one in hand.
bool World::replayPart(RunIndex index, base::WorkBudget& work, StepCounters& counters)
{
    bool isComplete = true;
    withContext(index, counters, [&](StepContext& context, Run& run) {
        const base::Ticks parts = partsOf(*run.effect);
        const base::Ticks begin = run.reached / run.stepLength * run.stepLength;
        base::Ticks part = 1;
        while (begin + run.stepLength * part / parts <= run.reached)
            ++part;
        const base::Ticks end = std::min(begin + run.stepLength * part / parts, run.target);
        LinkedPart* const own = linkedPartOf(run);
        std::optional<EventBoard> none; // of solvers without events
        if (own)
            context.scratch = &own->scratch;
        isComplete = stepPart(index, context, {run.reached, end}, own ? own->board : none, work);
        if (isComplete)
            run.reached = end;
    });
    return isComplete;
}

/// Ends what is in hand of a run that is not stepped with the others, so that its state can be copied.
void World::closeRun(RunIndex index)
{
    const Run& run = runs_.at(index);
    base::WorkBudget unlimited;
    if (run.arriving && run.inPart)
        replayPart(index, unlimited, closed_);
    else if (run.inStep)
        stepRun(index, {run.stepTick, run.stepLength}, unlimited, closed_);
}

} // namespace fx::sim
