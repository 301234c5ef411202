// The steps of an update, and what becomes of those that its budget of work does not cover.
#include "fxsdk/scene/scene.h"

#include <algorithm>
#include <chrono>
#include <new>
#include <utility>

namespace fx::scene {

namespace {
constexpr uint64_t kLateShare = 4; ///< of one part in so many of the work of an update, late ones are first
constexpr base::Ticks kMaxDroppedTicks = INT64_MAX; ///< no sum goes beyond it
} // namespace

bool Scene::update(double dt)
{
    const base::StepPlan plan = clock_.advance(dt);
    if (plan.refused) {
        ++counters_.refusedUpdates;
        return false;
    }
    if (plan.droppedTicks > 0)
        countDropped(plan.droppedTicks);
    work_ = base::WorkBudget(options_.workBudget);
    memoryFailed_ = false; // must not stop the steps that follow: the clock has already counted them
    if (plan.steps > 0) {
        takeSteps(plan);
    } else {
        if (sought_)
            heedSought(plan);
        std::lock_guard lock(presentation_);
        show(clock_.simulated(), clock_.interpolation());
    }
    if (marksWanted_.load(std::memory_order_relaxed) > 0)
        leaveMarks();
    if (memoryFailed_) {
        if (events_) // the last step was dropped with the events that it has recorded
            events_->lose(world_.readCues(active_.slots(), [](uint32_t, const sim::CueEvent&) {}));
        throw std::bad_alloc();
    }
    return true;
}

[[gnu::always_inline]] inline void Scene::takeSteps(const base::StepPlan& plan)
{
    update_ = {};
    if (isAtRest(clock_.simulated()))
        return passSteps(plan.steps);
    bool isPrepared = false, hasMoved = false;
    uint32_t taken = 0;
    for (; taken < plan.steps && !(taken > 0 && work_.isSpent()); ++taken) {
        const base::Ticks from = plan.firstStep + base::Ticks(taken) * clock_.stepTicks();
        const bool begins = !world_.isStepping();
        if (begins && !isPrepared)
            prepareSteps({plan.steps - taken, from});
        isPrepared = isPrepared || begins;
        try {
            hasMoved = hasMoved || (begins && !moved_.empty());
            if (begins && !moved_.empty())
                moveOn(taken + 1, plan.steps);
            if (begins && !motions_.empty())
                followMotions(from + clock_.stepTicks());
            if (begins)
                beginStep(from, taken + 1 == plan.steps);
            const base::Ticks to = from + clock_.stepTicks();
            const double moment = taken + 1 == plan.steps ? clock_.interpolation() : 0.0;
            if (!world_.isPublishing()) {
                if (!proceed())
                    break;
                endStep(to);
                if (taken + 2 >= plan.steps || isShort())
                    beginPublication(to, moment);
            }
            if (world_.isPublishing() && !proceedPublication(to, moment))
                break;
            if (world_.hasChanges() || !seeks_.empty())
                makeChanges();
        } catch (const std::bad_alloc&) {
            memoryFailed_ = true; // must not stop the steps that follow: the clock has already counted them
        }
    }
    if (hasMoved)
        endMoves(taken == plan.steps);
    if (taken < plan.steps)
        postpone(plan.steps - taken);
    update_.workUnits = work_.spent();
}

/// Whether steps that end by `until` have nothing to do and nothing to show.
[[gnu::always_inline]] inline bool Scene::isAtRest(base::Ticks until) const
{
    const auto isDue = [until](const activation::TimerQueue& queue) {
        return !queue.empty() && queue.earliest().start <= until;
    };
    const bool isEmpty = active_.size() == 0 && waking_.size() == 0 && denied_.size() == 0 &&
                         coarse_.size() == 0 && arrived_.empty() && world_.freeSolvers() == 0;
    const bool isAsked =
        visibilityStale_ || sought_ || !moved_.empty() || !seeks_.empty() || world_.hasChanges();
    return emptyPublications_ > kMaxEmptyPublications && isEmpty && !isAsked && !world_.isStepping() &&
           !isDue(dormant_) && !isDue(alarms_);
}

/// The steps of a scene at rest, all at once.
[[gnu::always_inline]] inline void Scene::passSteps(uint32_t steps)
{
    counters_.steps += steps;
    published_ = clock_.simulated();
    world_.passTime(published_);
    show(published_, clock_.interpolation());
}

/// Before the first step that begins in an update.
void Scene::prepareSteps(const base::StepPlan& plan)
{
    try {
        reconsider(plan);
        if (sought_)
            heedSought(plan);
    } catch (const std::bad_alloc&) {
        memoryFailed_ = true; // must not stop the steps; what is left of it is tried again
    }
}

/// The last steps of the plan found no work left. What is shown is the last that was published.
void Scene::postpone(uint32_t steps)
{
    clock_.postpone(steps);
    countDropped(clock_.dropDebt(options_.maxCatchUp));
    std::lock_guard lock(presentation_);
    show(published_, clock_.interpolation());
}

void Scene::countDropped(base::Ticks ticks)
{
    counters_.droppedTicks = std::min(counters_.droppedTicks, kMaxDroppedTicks - ticks) + ticks;
}

/// Work that may be spent on catching up before the steps of the update.
base::WorkBudget Scene::lateWork() const
{
    if (work_.left() == base::kNoWorkLimit)
        return base::WorkBudget();
    return base::WorkBudget(work_.left() / kLateShare + 1);
}

/// Whether the next step may well find too little work to be complete in this update.
bool Scene::isShort() const
{
    return work_.left() / 2 < stepWork_ + shownWork_;
}

[[gnu::always_inline]] inline void Scene::beginStep(base::Ticks from, bool isLast)
{
    const base::Ticks to = from + clock_.stepTicks();
    if (memoryFailed_ && events_) // the step before was dropped with the events that it has recorded
        events_->lose(world_.readCues(active_.slots(), [](uint32_t, const sim::CueEvent&) {}));
    stepWork_ = 0;
    stepEnd_ = to;
    if (!dormant_.empty())
        wake(to);
    if (!alarms_.empty())
        ringAlarms(to);
    if (!arrived_.empty())
        letArrive();
    if (std::exchange(hasStarted_, false) && isLast)
        stageReturned(from);
    if (active_.size() > 0)
        world_.beginStep(active_.slots(), from, clock_.stepTicks());
    else
        world_.passTime(to);
}

/// @return whether the open step is complete
[[gnu::always_inline]] inline bool Scene::proceed()
{
    if (!world_.isStepping())
        return true;
    const uint64_t before = work_.spent();
    sim::StepCounters done;
    const auto start = std::chrono::steady_clock::now();
    const bool isComplete = world_.proceed(work_, done);
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
    const bool isWhole = stepWork_ == 0;
    stepWork_ += work_.spent() - before;
    if (isWhole && isComplete)
        measureTime(took.count(), done.particleSteps);
    update_.work += done;
    counters_.work += done;
    return isComplete;
}

[[gnu::always_inline]] inline void Scene::endStep(base::Ticks to)
{
    if (coarse_.size() > 0 && to / clock_.stepTicks() % sim::kCoarseSteps == 0)
        for (const sim::Slot slot : coarse_.slots())
            world_.stepCoarsely(slot, clock_.stepTicks(), counters_.work, work_);
    ++counters_.steps;
    if (events_)
        recordEvents();
    if (active_.size() > 0) {
        retireFinished(to);
        restOrNot(to);
    }
    if (events_)
        events_->closeStep();
    if (world_.freeSolvers() > 0)
        world_.trimFreeList(to - options_.releaseAfter);
}

/// What the host has changed while the step was in hand.
void Scene::makeChanges()
{
    if (world_.hasChanges())
        world_.makeChanges();
    while (!seeks_.empty()) {
        const Seek wanted = seeks_.front();
        seeks_.erase(seeks_.begin());
        if (contains(wanted.id))
            static_cast<void>(seek(wanted.id, wanted.to)); // what has ended meanwhile stays where it is
    }
}

/// Simulates prewarm before the first step. Instances whose prewarm exceeds the work budget are waking from
/// then on, while the scene continues.
void Scene::letArrive()
{
    for (; !arrived_.empty(); arrived_.erase(arrived_.begin())) {
        if (!contains(arrived_.front()))
            continue;
        const uint32_t index = indexOf(arrived_.front());
        if (instances_.at(index).state != InstanceState::Active)
            continue;
        sim::StepCounters done;
        base::WorkBudget half(work_.left() == base::kNoWorkLimit ? work_.left() : work_.left() / 2);
        const bool isThere = world_.arrive(instances_.at(index).slot, clock_.stepTicks(), done, half);
        work_.spend(half.spent());
        counters_.work += done;
        if (!isThere)
            wait(index);
    }
}

/// An active instance that is not at the present yet is not shown before it is.
void Scene::wait(uint32_t index)
{
    Instance& instance = instances_.at(index);
    waking_.reserve(instances_.count());
    active_.remove(instance.serial);
    world_.hide(instance.slot);
    instance.wasResting = false;
    instance.isLate = true;
    instance.state = InstanceState::Waking;
    instance.reason = Reason::CatchingUp;
    waking_.insert(instance.serial, index, instance.slot);
}

/// Ends the open step, however much work it takes.
void Scene::completeStep()
{
    if (!world_.isStepping())
        return;
    work_ = base::WorkBudget();
    const base::Ticks to = clock_.simulated() + clock_.stepTicks();
    const bool isComplete = world_.isPublishing();
    if (!isComplete) {
        proceed();
        endStep(to);
    }
    clock_.takePostponed();
    if (!isComplete)
        beginPublication(to, clock_.interpolation());
    if (world_.isPublishing())
        proceedPublication(to, clock_.interpolation());
    makeChanges();
}

} // namespace fx::scene
