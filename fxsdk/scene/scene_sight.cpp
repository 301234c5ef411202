// Visibility: instances go out of sight and come back; hidden instances are not visited.
#include "fxsdk/scene/scene.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <new>

namespace fx::scene {

namespace {

constexpr uint64_t kBytesPerParticle = 128; ///< of a solver and its snapshots, for budgets
constexpr double kRounding = 1e-6;          ///< [1] of a cosine, more than that of floats
constexpr double kUnlimited = std::numeric_limits<double>::infinity();

Reason reasonOf(activation::Sight sight)
{
    switch (sight) {
    case activation::Sight::Outside:
        return Reason::Outside;
    case activation::Sight::TooFar:
        return Reason::TooFar;
    case activation::Sight::TooSmall:
        return Reason::TooSmall;
    case activation::Sight::Seen:
        break;
    }
    return Reason::None;
}

double sightOf(const ActivationHints& hints)
{
    return hints.maxDistance > 0 ? double(hints.maxDistance) : kUnlimited;
}

} // namespace

bool Scene::mayHide(const Instance& instance) const
{
    if (!options_.culling || instance.policy == sim::CatchUp::Authoritative)
        return false;
    return !options_.lockStep || (isExact(instance.policy) && !instance.setup.destroyWhenFinished);
}

BoundsInputs Scene::boundsInputsOf(const InstanceSetup& setup, const sim::Influence& influence) const
{
    const base::Placement& to = setup.placement;
    const base::Placement& from = setup.cameFrom ? *setup.cameFrom : to;
    BoundsInputs is;
    is.low = is.high = to.position;
    is.smallest = is.largest = to.scale;
    is.wind = glm::length(setup.parameters.wind);
    is.localWind = is.wind / to.scale;
    is.slowest = setup.clock ? setup.clock->rate : setup.rate;
    double way = glm::length(to.position - from.position); // perhaps within one step
    if (from.rotation != to.rotation || from.scale != to.scale) {
        const double cosine = double(glm::dot(from.rotation, to.rotation)); // of half the angle
        const double chord = 2.0 * std::sqrt(std::max(1.0 - cosine * cosine, 0.0) + kRounding);
        way += double(influence.extent) * (chord * double(std::max(from.scale, to.scale)) +
                                           std::abs(double(to.scale) - double(from.scale)));
    }
    if (is.slowest > 0 && way > 0.0)
        is.speed =
            way / (base::toSeconds(clock_.stepTicks()) * (double(is.slowest) / double(sim::kNormalRate)));
    return is;
}

/// What has to be reckoned with besides what is so now: kept where particles stay behind, and from the first
/// time on that the wind grows weaker.
BoundsInputs Scene::pastOf(Instance& instance, bool stays, const sim::Influence& influence) const
{
    const BoundsInputs is = boundsInputsOf(instance.setup, influence);
    const float before = instance.reachWind - glm::length(instance.setup.effect->wind);
    const bool calms = instance.reachWind >= 0.0f && is.localWind < before;
    if (!instance.past && (stays || calms)) {
        instance.past.reset(new (std::nothrow) MotionHistory);
        BoundsInputs was = is;
        was.localWind = std::max(was.localWind, before);
        if (!instance.past)
            return was; // stays as far as it was, for ever
        instance.past->note(clock_.simulated(), was, influence.seconds);
    }
    if (!instance.past)
        return is;
    instance.past->note(clock_.simulated(), is, influence.seconds);
    return instance.past->all();
}

/// The ball is about where the instance is now; what is alive may have been born elsewhere and blown by
/// another wind.
void Scene::measure(Instance& instance) const
{
    const InstanceSetup& setup = instance.setup;
    const sim::EffectDef& effect = *setup.effect;
    const sim::Influence influence = effect.influence();
    const bool stays = effect.dependsOnPlacement() && !(effect.bound > 0);
    const BoundsInputs past = pastOf(instance, stays, influence);
    const float wind = glm::length(effect.wind) + (stays ? past.wind / past.smallest : past.localWind);
    if (wind != instance.reachWind) {
        instance.localReach = effect.reach(glm::length(options_.environment.gravity), wind);
        instance.reachWind = wind;
    }
    if (!stays) {
        instance.reach = instance.past && !instance.past->isKnown()
                             ? kUnlimited
                             : double(setup.placement.scale) * double(instance.localReach);
        return;
    }
    const glm::dvec3 away =
        glm::max(past.high - setup.placement.position, setup.placement.position - past.low);
    const double carried = double(influence.inherits) * past.speed;
    const double flown = carried > 0.0 ? carried * double(influence.seconds + influence.drawnOut) : 0.0;
    instance.reach = instance.past && instance.past->isKnown()
                         ? glm::length(away) + double(past.largest) * double(instance.localReach) + flown
                         : kUnlimited;
}

activation::Ball Scene::ballOf(const Instance& instance) const
{
    return {instance.setup.placement.position, instance.reach};
}

double Scene::significanceOf(const Instance& instance) const
{
    return focus_.pixels(ballOf(instance)) * double(instance.hints.priority);
}

uint64_t Scene::particlesOf(const Instance& instance) const
{
    if (instance.state == InstanceState::Active)
        return world_.elementCount(instance.slot);
    return instance.lastParticles > 0 ? instance.lastParticles : instance.setup.effect->capacity();
}

/// None when it is to be seen.
Reason Scene::judge(const Instance& instance, bool isSeen)
{
    if (instance.hints.occluded)
        return Reason::Occluded;
    if (focus_.everything())
        return Reason::None;
    ++update_.judged;
    return reasonOf(focus_.judge(ballOf(instance), sightOf(instance.hints), isSeen));
}

void Scene::setFocus(std::span<const activation::Frustum> frusta)
{
    focus_.reserve(frusta.size()); // may throw; afterwards nothing does
    focus_.clear();
    for (const activation::Frustum& frustum : frusta)
        focus_.add(frustum);
    visibilityStale_ = true;
}

void Scene::setBudget(const activation::Budget& budget)
{
    budget_ = budget;
    visibilityStale_ = true;
}

void Scene::setHints(LocalId id, const ActivationHints& hints)
{
    Instance& instance = *instances_.find(id);
    const ActivationHints before = instance.hints;
    instance.hints = hints;
    visibilityStale_ = true;
    if (instance.state != InstanceState::Hidden || instance.reason == Reason::Budget)
        return;
    const Reason reason = judge(instance, false); // it would not be tested again otherwise
    if (reason == Reason::None)
        return comeBack(indexOf(id));
    const bool isInTree = instance.leaf != activation::SphereHierarchy::kNone;
    if (isInTree)
        tree_.remove(instance.leaf);
    instance.leaf = activation::SphereHierarchy::kNone;
    try {
        if (reason != Reason::Occluded)
            instance.leaf = tree_.insert(indexOf(id), ballOf(instance), sightOf(hints));
    } catch (...) { // only when it was occluded: what was in the tree leaves room
        instance.hints = before;
        throw;
    }
    instance.reason = reason;
}

void Scene::setPlacement(LocalId id, const base::Placement& placement)
{
    Instance& instance = *instances_.find(id);
    if (instance.state != InstanceState::Dormant && instance.state != InstanceState::Finished) {
        if (instance.setup.effect->dependsOnPlacement() && !instance.setup.cameFrom)
            moved_.push_back(id); // may throw, as the next may
        world_.setPlacement(instance.slot, placement);
        if (instance.setup.effect->dependsOnPlacement() && !instance.setup.cameFrom)
            instance.setup.cameFrom = instance.setup.placement;
    }
    if (!motions_.empty())
        endMotion(id);
    placeAt(id, instance, placement);
}

/// What follows from a placement that the world knows already.
void Scene::placeAt(LocalId id, Instance& instance, const base::Placement& placement)
{
    instance.setup.placement = placement;
    measure(instance);
    visibilityStale_ = true;
    if (instance.leaf != activation::SphereHierarchy::kNone) {
        tree_.remove(instance.leaf);
        instance.leaf = tree_.insert(indexOf(id), ballOf(instance), sightOf(instance.hints)); // has room
    }
    const bool isPaused = instance.state == InstanceState::Hidden || instance.state == InstanceState::Resting;
    if (isPaused && world_.hasManyChanges(instance.slot))
        comeBack(indexOf(id));
}

void Scene::setParameters(LocalId id, const sim::InstanceParameters& parameters)
{
    Instance& instance = *instances_.find(id);
    if (instance.state != InstanceState::Dormant && instance.state != InstanceState::Finished)
        world_.setParameters(instance.slot, parameters); // may throw
    instance.setup.parameters = parameters;
    measure(instance);
    visibilityStale_ = true;
    if (instance.state == InstanceState::Resting ||
        (instance.state == InstanceState::Hidden && world_.hasManyChanges(instance.slot)))
        comeBack(indexOf(id));
}

void Scene::reconsider(const base::StepPlan& plan)
{
    if (visibilityStale_)
        updateVisibility();
    if (budget_.any())
        keepBudget();
    if (waking_.size() == 0)
        return;
    base::WorkBudget late = lateWork();
    catchUpWaking(late);
    work_.spend(late.spent());
    if (plan.steps == 1 && update_.returned > 0)
        stageReturned(plan.firstStep);
}

void Scene::updateVisibility()
{
    visibilityStale_ = false;
    const auto leaves = [this](uint32_t index, sim::Slot) {
        Instance& instance = instances_.at(index);
        if (instance.past && !instance.past->isSettled())
            measure(instance); // what was once may be over
        const Reason reason = mayHide(instance) ? judge(instance, true) : Reason::None;
        return reason != Reason::None && sendOut(index, reason);
    };
    active_.removeIf(leaves);
    waking_.removeIf(leaves);
    candidates_.clear();
    candidates_.reserve(tree_.size());
    update_.judged += tree_.query(focus_, [this](uint32_t index) {
        activation::Candidate candidate;
        candidate.key = index;
        candidates_.push_back(candidate);
    });
    for (const activation::Candidate& candidate : candidates_)
        comeBack(candidate.key);
    lookAtDenied();
}

/// Instances denied by the budget may be out of sight by now, or there is no budget any more.
void Scene::lookAtDenied()
{
    candidates_.clear();
    candidates_.reserve(denied_.size());
    for (const uint32_t index : denied_.keys()) {
        candidates_.push_back({});
        candidates_.back().key = index;
    }
    for (const activation::Candidate& candidate : candidates_) {
        const Instance& instance = instances_.at(candidate.key);
        const Reason reason = judge(instance, true);
        if (reason == Reason::None && !budget_.any())
            comeBack(candidate.key);
        else if (reason != Reason::None && sendOut(candidate.key, reason))
            denied_.remove(instance.serial);
    }
}

/// Hides visible instances that exceed the budget, and shows those that fit again.
void Scene::keepBudget()
{
    candidates_.clear();
    candidates_.reserve(active_.size() + waking_.size() + denied_.size());
    const auto collect = [this](const activation::ActiveList& list, bool runs) {
        for (const uint32_t index : list.keys()) {
            const Instance& instance = instances_.at(index);
            const uint64_t bytes = kBytesPerParticle * instance.setup.effect->capacity();
            candidates_.push_back({significanceOf(instance), instance.serial, particlesOf(instance), bytes,
                                   index, runs, !mayHide(instance), false});
        }
    };
    collect(active_, true);
    collect(waking_, true);
    collect(denied_, false);
    activation::share(budget_, nanosecondsPerParticle(), candidates_);
    for (const activation::Candidate& candidate : candidates_) {
        if (candidate.granted == candidate.runs)
            continue;
        Instance& instance = instances_.at(candidate.key);
        if (candidate.granted) {
            denied_.remove(instance.serial);
            comeBack(candidate.key);
            continue;
        }
        const bool wasActive = instance.state == InstanceState::Active;
        if (sendOut(candidate.key, Reason::Budget))
            (wasActive ? active_ : waking_).remove(instance.serial);
    }
    update_.denied = uint32_t(denied_.size());
}

/// The caller takes it from the list that it was in. @return false when there is no memory: it stays
bool Scene::sendOut(uint32_t index, Reason reason)
{
    Instance& instance = instances_.at(index);
    const bool wasActive = instance.state == InstanceState::Active;
    try {
        if (wasActive)
            instance.lastParticles = world_.elementCount(instance.slot);
        place(index, reason);
    } catch (const std::bad_alloc&) {
        memoryFailed_ = true;
        return false;
    }
    if (wasActive) {
        world_.hide(instance.slot);
        ++update_.hidden;
    }
    return true;
}

/// Enters an instance where it is found again. Strong guarantee.
void Scene::place(uint32_t index, Reason reason)
{
    Instance& instance = instances_.at(index);
    const bool isInTree = reason == Reason::Outside || reason == Reason::TooFar || reason == Reason::TooSmall;
    alarms_.reserve(index, alarms_.size() + 1);
    if (reason == Reason::Budget)
        denied_.reserve(denied_.size() + 1);
    if (instance.policy == sim::CatchUp::Coarse)
        coarse_.reserve(coarse_.size() + 1);
    waking_.reserve(waking_.size() + denied_.size() + tree_.size() + hidden_ + 1);
    if (isInTree)
        instance.leaf = tree_.insert(index, ballOf(instance), sightOf(instance.hints));
    if (reason == Reason::Budget)
        denied_.insert(instance.serial, index, instance.slot);
    const bool wasHidden = instance.state == InstanceState::Hidden;
    const bool holdsMemory = instance.state != InstanceState::Dormant;
    instance.state = InstanceState::Hidden;
    instance.reason = reason;
    if (wasHidden)
        return; // its alarm and its list go on
    if (instance.policy == sim::CatchUp::Coarse)
        coarse_.insert(instance.serial, index, instance.slot);
    ++hidden_;
    const base::Ticks end = endOf(instance);
    setAlarm(index, holdsMemory ? std::min(clock_.simulated() + options_.releaseAfter, end) : end);
}

/// The opposite: removes it from all lists of hidden, resting and waking instances.
void Scene::takeBack(uint32_t index)
{
    Instance& instance = instances_.at(index);
    if (instance.hasAlarm)
        alarms_.remove(index);
    instance.hasAlarm = false;
    if (instance.leaf != activation::SphereHierarchy::kNone)
        tree_.remove(instance.leaf);
    instance.leaf = activation::SphereHierarchy::kNone;
    if (instance.state == InstanceState::Waking)
        waking_.remove(instance.serial);
    if (instance.state == InstanceState::Resting)
        --resting_;
    if (instance.state != InstanceState::Hidden)
        return;
    --hidden_;
    if (instance.reason == Reason::Budget)
        denied_.removeIf([index](uint32_t key, sim::Slot) { return key == index; });
    if (instance.policy == sim::CatchUp::Coarse)
        coarse_.remove(instance.serial);
}

base::Ticks Scene::endOf(const Instance& instance) const
{
    const base::Ticks duration = instance.setup.effect->duration;
    if (duration <= 0)
        return std::numeric_limits<base::Ticks>::max();
    const InstanceSetup& setup = instance.setup;
    const sim::InstanceClock atStart{setup.startTick, setup.effect->prewarm, setup.rate};
    return setup.clock.value_or(atStart).toScene(duration);
}

void Scene::setAlarm(uint32_t index, base::Ticks tick)
{
    Instance& instance = instances_.at(index);
    if (instance.hasAlarm)
        alarms_.remove(index);
    instance.hasAlarm = tick < std::numeric_limits<base::Ticks>::max();
    if (instance.hasAlarm)
        alarms_.add({tick, instance.serial, index});
}

} // namespace fx::scene
