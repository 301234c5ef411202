#include "fxsdk/scene/scene.h"

#include <algorithm>
#include <new>
#include <utility>

namespace fx::scene {

Scene::Scene(const SceneOptions& options, const base::SnapshotSchema* schema, base::TaskRunner* tasks,
             std::pmr::memory_resource* memory)
    : options_(options), schema_(schema), tasks_(tasks), memory_(memory),
      clock_(options.stepTicks, options.maxFrameTicks),
      world_(schema, tasks, memory, options.environment, options.shareInstances),
      instances_(memory, options.maxInstances), dormant_(memory), active_(memory), waking_(memory),
      denied_(memory), coarse_(memory), tree_(memory), alarms_(memory), focus_(memory), candidates_(memory),
      arrived_(memory), seeks_(memory), moved_(memory), motions_(memory), reservations_(memory),
      ring_(schema, memory), rules_(memory), marks_(memory), newMarks_(memory)
{
    world_.allowRest(options.culling);
    if (options.eventCapacity > 0) {
        events_.emplace(memory, options.eventCapacity);
        if (options.cueEvents || options.unnamedEvents)
            world_.recordCues(options.eventCapacity, options.cueEvents, options.unnamedEvents);
    }
    ring_.beginWrite(0); // so that acquire() always has something to show
    ring_.publish();
}

LocalId Scene::add(InstanceSetup setup, const DisplayRule& rule)
{
    if (!rule.isDefault())
        rules_.reserveOne();
    const base::Ticks now = present();
    setup.startTick = std::max(setup.startTick, now);
    const bool startsNow = setup.startTick < now + clock_.stepTicks() && !world_.isStepping();

    active_.reserve(instances_.count() + size_t(1)); // so that waking cannot fail for lack of a list entry
    Instance instance;
    instance.setup = std::move(setup);
    instance.serial = nextSerial_;
    instance.state = InstanceState::Dormant;
    instance.policy = instance.setup.effect->catchUp();
    measure(instance);
    const base::Ticks start = instance.setup.startTick;
    const LocalId id = instances_.add(std::move(instance));
    if (id == 0)
        return 0;
    try {
        if (startsNow)
            enterWorld(indexOf(id));
        else
            dormant_.add({start, nextSerial_, indexOf(id)});
    } catch (...) {
        instances_.cancel(id);
        throw;
    }
    ++nextSerial_;
    countHints(*instances_.find(id), 1);
    rules_.set(id, rule);
    return id;
}

void Scene::countHints(const Instance& instance, int more)
{
    preferring_.add(instance.setup.effect->hints, more);
    hints_.store(preferring_.greatest(), std::memory_order_relaxed);
}

void Scene::remove(LocalId id)
{
    Instance& instance = *instances_.find(id);
    if (instance.state == InstanceState::Dormant)
        dormant_.remove(indexOf(id));
    if (instance.state == InstanceState::Active) {
        active_.remove(instance.serial);
        world_.remove(instance.slot);
    } else if (instance.state >= InstanceState::Waking) {
        takeBack(indexOf(id));
        world_.remove(instance.slot);
    }
    if (instance.state == InstanceState::Finished)
        --counters_.finished;
    else
        countHints(instance, -1);
    instances_.remove(id);
    rules_.retire(id, options_.maxInstances);
    if (!motions_.empty())
        endMotion(id);
}

uint32_t Scene::particles(LocalId id)
{
    const Instance& instance = *instances_.find(id);
    const bool isInWorld =
        instance.state != InstanceState::Dormant && instance.state != InstanceState::Finished;
    return isInWorld ? world_.elementCount(instance.slot) : 0;
}

base::Status Scene::setCollisionMesh(const sim::TriangleMesh* mesh, float cellSize)
{
    completeStep();
    if (!mesh) {
        world_.setField(nullptr);
        return {};
    }
    base::Result<std::shared_ptr<const sim::DistanceField>> field =
        sim::DistanceField::build(*mesh, cellSize, *tasks_, memory_);
    if (field)
        world_.setField(std::move(*field));
    return field.status();
}

void Scene::wake(base::Ticks until)
{
    while (!dormant_.empty() && dormant_.earliest().start < until) {
        const uint32_t index = dormant_.earliest().key;
        dormant_.remove(index);
        try {
            enterWorld(index);
        } catch (const std::bad_alloc&) {
            ++counters_.wakeFailures;
            finish(index);
        }
    }
}

void Scene::enterWorld(uint32_t index)
{
    Instance& instance = instances_.at(index);
    const Reason reason = mayHide(instance) ? judge(instance, false) : Reason::None;
    if (reason != Reason::None) {
        instance.slot = world_.add(instance.setup.effect, startOf(instances_, index), true);
        try {
            place(index, reason);
        } catch (...) {
            world_.remove(instance.slot);
            throw;
        }
        return;
    }
    const bool hasPast =
        instance.setup.clock ? instance.setup.clock->local > 0 : instance.setup.effect->prewarm > 0;
    if (hasPast) {
        waking_.reserve(instances_.count()); // where it goes when its past takes long
        arrived_.push_back(instances_.idAt(index));
    }
    instance.slot = world_.add(instance.setup.effect, startOf(instances_, index));
    instance.state = InstanceState::Active;
    active_.insert(instance.serial, index, instance.slot);
    hasStarted_ = hasStarted_ || instance.setup.effect->startsInMotion();
}

sim::InstanceStart Scene::startOf(const IdTable<Instance>& instances, uint32_t index)
{
    const InstanceSetup& setup = instances.at(index).setup;
    sim::InstanceStart start;
    start.instance = instances.idAt(index);
    start.seed = setup.seed;
    start.startTick = setup.startTick;
    start.placement = setup.placement;
    start.parameters = setup.parameters;
    start.quality = setup.quality;
    start.rate = setup.rate;
    start.clock = setup.clock;
    return start;
}

void Scene::retireFinished(base::Ticks now)
{
    active_.removeIf([&](uint32_t index, sim::Slot slot) {
        if (!world_.finished(slot, now))
            return false;
        world_.recycle(slot);
        finish(index);
        return true;
    });
}

void Scene::finish(uint32_t index)
{
    countHints(instances_.at(index), -1);
    if (events_ && options_.finishedEvents) {
        const Instance& instance = instances_.at(index);
        SceneEvent event;
        event.instance = instances_.idAt(index);
        event.userData = instance.setup.userData;
        event.tick = stepEnd_;
        event.position = instance.setup.placement.position;
        events_->add(event, instance.serial);
    }
    if (!motions_.empty())
        endMotion(instances_.idAt(index));
    if (instances_.at(index).setup.destroyWhenFinished) {
        rules_.retire(instances_.idAt(index), options_.maxInstances);
        instances_.remove(instances_.idAt(index));
        return;
    }
    instances_.at(index).state = InstanceState::Finished;
    instances_.at(index).reason = Reason::Ended;
    ++counters_.finished;
}

/// Publishes the step that ends at `tick` if there is nothing to be seen; otherwise its publication is in
/// hand.
void Scene::beginPublication(base::Ticks tick, double interpolation)
{
    if (active_.size() > 0 && emptyPublications_ > kMaxEmptyPublications)
    { // the step before is what views interpolate from
        ring_.beginWrite(tick - clock_.stepTicks(), clock_.stepTicks());
        ring_.publish();
    }
    emptyPublications_ = active_.size() > 0 ? 0 : emptyPublications_ + 1;
    if (emptyPublications_ > kMaxEmptyPublications)
    { // what is shown, and what was before it, is as empty as this
        published_ = tick;
        emptyPublications_ = kMaxEmptyPublications + 1;
        showsNothing_.store(true, std::memory_order_release);
        rules_.countPublication();
        return show(tick, interpolation);
    }
    shownWork_ = 0;
    world_.beginPublication(active_.slots(), ring_.beginWrite(tick, clock_.stepTicks()));
}

/// Writes the open publication as far as the work goes. Readers see it once it is complete.
/// @return whether it is
bool Scene::proceedPublication(base::Ticks tick, double interpolation)
{
    const uint64_t before = work_.spent();
    const bool isWritten = world_.proceedPublication(work_);
    shownWork_ += work_.spent() - before;
    if (!isWritten)
        return false;
    published_ = tick;
    showsNothing_.store(false, std::memory_order_release);
    std::lock_guard lock(presentation_);
    ring_.publish();
    rules_.countPublication();
    if (std::exchange(replaced_, false))
        ring_.forgetOlder();
    show(tick, interpolation);
    return true;
}

/// Publishes the last step again, with the instances that have come back or started since: views interpolate
/// from it.
/// Where that takes too much work, these instances appear a step later.
void Scene::stageReturned(base::Ticks tick)
{
    try {
        base::WorkBudget share = lateWork();
        world_.beginPublication(active_.slots(), ring_.beginWrite(tick, clock_.stepTicks()));
        const bool isWritten = world_.proceedPublication(share);
        work_.spend(share.spent());
        if (!isWritten)
            return world_.dropPublication();
        ring_.stageOlder();
        emptyPublications_ = 0;
        replaced_ = false;
    } catch (const std::bad_alloc&) {
        memoryFailed_ = true; // they appear a step later
    }
}

void Scene::show(base::Ticks newest, double interpolation)
{
    const double time =
        std::max(base::toSeconds(newest) - (1.0 - interpolation) * base::toSeconds(clock_.stepTicks()), 0.0);
    interpolation_.store(interpolation, std::memory_order_relaxed);
    shownTime_.store(time, std::memory_order_relaxed);
}

SceneCounters Scene::counters() const
{
    SceneCounters now = counters_;
    now.instances = instances_.count();
    now.dormant = uint32_t(dormant_.size());
    now.resting = resting_ + std::min(world_.resting(), uint32_t(active_.size()));
    now.active = uint32_t(active_.size()) + resting_ - now.resting;
    now.waking = uint32_t(waking_.size());
    now.hidden = hidden_;
    now.simulations = world_.simulations();
    return now;
}

uint32_t Scene::particles() const
{
    uint32_t sum = 0;
    for (const sim::Slot slot : active_.slots())
        sum += world_.elementCount(slot);
    return sum;
}

uint64_t Scene::stateHash()
{
    work_ = base::WorkBudget(options_.workBudget);
    if (sought_ && !world_.isStepping())
        showSought();
    const Presentation shown = acquire();
    const uint64_t hash =
        shown.snapshots.newer->hashAt(published_); // may be written for earlier, with nothing in it
    release(shown.snapshots);
    return hash;
}

Presentation Scene::acquire()
{
    std::lock_guard lock(presentation_);
    return {ring_.acquire(), interpolation_.load(std::memory_order_relaxed),
            shownTime_.load(std::memory_order_relaxed), hints_.load(std::memory_order_relaxed)};
}

} // namespace fx::scene
