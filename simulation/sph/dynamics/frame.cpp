#include "simulation/sph/dynamics/gas_operations.h"

#include "simulation/sph/dynamics/evaluation.h"
#include "simulation/sph/dynamics/heat_input.h"
#include "simulation/sph/dynamics/neighborhood.h"
#include "simulation/sph/dynamics/prediction.h"
#include "simulation/sph/dynamics/stepping.h"

#include <algorithm>

namespace fx::sim {

namespace {

/// A frame is at most this many of its first shortest steps long, so that steps can shrink a thousand times a
/// thousand times before they meet the tick; longer times are cut into frames.
constexpr double kMaxSteps = 1 << 20;

/// [unit] of a sub-step: of all particles, of those whose rates are evaluated, and of their ordered pairs.
uint64_t workOf(uint64_t particles, uint64_t evaluated, uint64_t pairs)
{
    return particles * gas_work::kParticle / gas_work::kParts + evaluated * gas_work::kEvaluation +
           pairs * gas_work::kPair / gas_work::kParts;
}

/// Particles where they are now, sorted when searches have become slow.
template <class T>
void lookAround(DynamicsState<T>& s, base::TaskRunner& tasks)
{
    predict(s, tasks);
    if (treeIsGood(s))
        return;
    sortParticles(s, tasks);
    predict(s, tasks);
}

/// Keeps account of how far particles have moved since their lists were made.
template <class T>
void countWay(ListState& lists, const DynamicsState<T>& s, uint64_t ticks)
{
    lists.perStep = s.fastest * double(ticks) * s.tick;
    lists.moved += lists.perStep * (1.0 + lists.growth);
}

template <class T>
void evaluateActive(DynamicsState<T>& s, base::TaskRunner& tasks)
{
    evaluateDensity(s, tasks);
    evaluateState(s, tasks);
    evaluateForces(s, tasks);
}

/// Gives out the heat that is due. What has just been evaluated and closed is evaluated again: the new step
/// begins with the forces of the heat, the old one has ended without.
template <class T>
void heatNow(DynamicsState<T>& s, base::TaskRunner& tasks)
{
    for (const uint32_t i : s.activeSlots())
        s.gas.begin[i] = s.now;
    giveDelayedHeat(s);
    evaluateState(s, tasks);
    evaluateForces(s, tasks);
}

/// All particles end their step at `end`.
template <class T>
void truncateAll(DynamicsState<T>& s, uint64_t end)
{
    for (uint32_t i = 0; i < s.count; ++i)
        if (s.gas.end[i] > end)
            shortenStep(s, i, end);
}

/// One sub-step, to the next end of any particle's step. @return active particles
template <class T>
uint32_t subStep(DynamicsState<T>& s, bool isLast, base::TaskRunner& tasks)
{
    const uint64_t before = s.now;
    const uint64_t next = std::min(s.nextEnd.load(), nextHeat(s));
    if (isLast || (s.def.steps == StepScheme::Global && next < s.nextEnd))
        truncateAll(s, next);
    s.now = next;
    s.heatedNow = false;
    wakeHeated(s);
    lookAround(s, tasks);
    countWay(s.listState, s, s.now - before);
    evaluateActive(s, tasks);
    closeSteps(s, tasks);
    uint32_t evaluated = s.activeCount;
    if (s.heatedNow) {
        heatNow(s, tasks);
        evaluated += s.activeCount;
    }
    if (s.now == kFrameTicks || isLast) {
        limitWantedSteps(s, tasks);
        return evaluated;
    }
    openSteps(s, tasks);
    if (wakeNeighbors(s, tasks) > 0) {
        evaluateActive(s, tasks);
        closeSteps(s, tasks);
        openSteps(s, tasks);
        evaluated += s.activeCount;
    }
    return evaluated;
}

/// Ticks and lists of a moment between frames.
template <class T>
void rest(DynamicsState<T>& s)
{
    s.now = 0;
    s.activeCount = 0;
    s.listsServeActive = false;
    for (uint32_t i = 0; i < s.count; ++i)
        s.gas.begin[i] = s.gas.end[i] = s.gas.drifted[i] = 0;
    std::fill_n(s.blockChanged.data(), blockCount(s.count), uint8_t(1));
}

} // namespace

template <class T>
void prepare(DynamicsState<T>& s, base::TaskRunner& tasks)
{
    if (s.count == 0 || !(s.fresh || s.stale))
        return;
    if (s.mustRecoverTree)
        recoverTree(s, tasks);
    s.tick = 0;
    rest(s);
    if (s.fresh)
        findFirstDensities(s, tasks);
    s.heatedNow = s.shaken;
    lookAround(s, tasks);  // all are active: steps of no length end now
    measureWays(s, tasks); // outer physics may have moved particles
    evaluateActive(s, tasks);
    limitWantedSteps(s, tasks);
    rest(s);
    s.fresh = s.stale = s.shaken = false;
}

template <class T>
AdvanceReport runFrames(DynamicsState<T>& s, double seconds, base::TaskRunner& tasks, base::WorkBudget& work)
{
    Advance& advance = s.advance;
    AdvanceReport& report = advance.report;
    if (!advance.isOpen) {
        advance = {true, seconds, 0.0, {}};
        s.clamped = 0;
        s.pairSum = s.searches = 0;
        if (s.mustRecoverTree)
            recoverTree(s, tasks);
        prepare(s, tasks);
        work.spend(workOf(s.count, s.count, s.pairSum));
    }
    while (advance.left > 0 && s.count > 0 && report.subSteps < s.def.maxSubSteps) {
        if (advance.frame == 0.0) {
            advance.frame = std::min(advance.left, kMaxSteps * shortestStep(s, tasks));
            openFrame(s, advance.frame, tasks);
        }
        while (s.now < kFrameTicks && report.subSteps < s.def.maxSubSteps) {
            if (work.isSpent())
                return report;
            const bool isLast = report.subSteps + 1 == s.def.maxSubSteps;
            const uint64_t pairsBefore = s.pairSum;
            const uint32_t evaluated = subStep(s, isLast, tasks);
            work.spend(workOf(s.count, evaluated, s.pairSum - pairsBefore));
            report.particleSteps += evaluated;
            ++report.subSteps;
        }
        const double done = s.now == kFrameTicks ? advance.frame : double(s.now) * s.tick;
        advance.left = done == advance.left ? 0.0 : advance.left - done;
        advance.frame = 0.0;
        passTime(s, done);
        rest(s);
    }
    advance.isOpen = false;
    report.debt = s.count > 0 ? advance.left : 0.0;
    report.seconds = seconds - report.debt;
    report.pairs = s.pairSum;
    report.searches = s.searches;
    report.clamped = s.clamped;
    return report;
}

#define FX_INSTANTIATE(T)                                                                                    \
    template void prepare<T>(DynamicsState<T>&, base::TaskRunner&);                                          \
    template AdvanceReport runFrames<T>(DynamicsState<T>&, double, base::TaskRunner&, base::WorkBudget&);
FX_INSTANTIATE(float)
FX_INSTANTIATE(double)
#undef FX_INSTANTIATE

} // namespace fx::sim
