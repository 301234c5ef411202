// How a scene is saved, restored and hashed.
#include "fxsdk/scene/scene.h"

#include <algorithm>
#include <memory>
#include <new>
#include <utility>

namespace fx::scene {

namespace {

/// Whether particles get farther in a gale.
bool isBlown(const sim::EffectDef& effect)
{
    constexpr float kGravity = 9.81f, kGale = 100.0f;
    return effect.reach(kGravity, kGale) > effect.reach(kGravity, 0.0f);
}

constexpr base::Ticks kLatestTick = INT64_MAX / 4;             ///< no clock and no start goes beyond it
constexpr base::Ticks kMaxDebt = 3600 * base::kTicksPerSecond; ///< that updates can have left
constexpr double kFarthest = 1e9;                              ///< [m]
constexpr int kHasGround = 1, kHasField = 2;                   ///< bits of a byte of the rules

void savePlacement(sim::StateWriter& writer, const base::Placement& placement)
{
    writer.vector(placement.position);
    writer.rotation(placement.rotation);
    writer.value(placement.scale);
}

void saveSetup(sim::StateWriter& writer, const InstanceSetup& setup)
{
    writer.value(setup.seed);
    writer.value(setup.startTick);
    savePlacement(writer, setup.placement);
    writer.flag(setup.cameFrom.has_value());
    if (setup.cameFrom)
        savePlacement(writer, *setup.cameFrom);
    writer.value(setup.parameters.intensity);
    writer.vector(setup.parameters.wind);
    writer.flag(setup.parameters.emitting);
    writer.vector(setup.parameters.tint);
    writer.flag(setup.destroyWhenFinished);
    writer.value(setup.quality);
    writer.value(setup.rate);
    writer.flag(setup.clock.has_value());
    const sim::InstanceClock clock = setup.clock.value_or(sim::InstanceClock{});
    writer.value(clock.scene);
    writer.value(clock.local);
    writer.value(clock.rate);
}

base::Placement restorePlacement(sim::StateReader& reader)
{
    base::Placement placement;
    placement.position = reader.doubleVector();
    placement.rotation = reader.rotation();
    placement.scale = reader.value<float>(1e-3f, 1e3f, "an instance's scale is out of range");
    const glm::dvec3 distance = glm::abs(placement.position);
    reader.require(std::max({distance.x, distance.y, distance.z}) <= kFarthest,
                   "an instance is too far away");
    const glm::quat& q = placement.rotation;
    const float length2 = q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w;
    reader.require(length2 > 0.99f && length2 < 1.01f, "a rotation is not a unit quaternion");
    return placement;
}

/// All but the effect.
InstanceSetup restoreSetup(sim::StateReader& reader)
{
    InstanceSetup setup;
    setup.seed = reader.value<uint64_t>();
    setup.startTick = reader.value<base::Ticks>(0, kLatestTick, "an instance starts out of range");
    setup.placement = restorePlacement(reader);
    if (reader.flag())
        setup.cameFrom = restorePlacement(reader);
    setup.parameters.intensity = reader.value<float>(0.0f, 1e3f, "an intensity is out of range");
    setup.parameters.wind = reader.vector();
    setup.parameters.emitting = reader.flag();
    for (int k = 0; k < 3; ++k)
        setup.parameters.tint[k] = reader.value<float>(0.0f, 1.0f, "a tint is out of range");
    setup.destroyWhenFinished = reader.flag();
    setup.quality =
        reader.value(sim::QualityLevel::Low, sim::QualityLevel::Reference, "a quality is out of range");
    setup.rate = reader.value<uint32_t>(0, sim::kHighestRate, "a rate is out of range");
    const bool hasClock = reader.flag();
    sim::InstanceClock clock;
    clock.scene = reader.value<base::Ticks>(0, kLatestTick, "a clock is out of range");
    clock.local = reader.value<base::Ticks>(0, kLatestTick, "a clock is out of range");
    clock.rate = reader.value<uint32_t>(0, sim::kHighestRate, "a rate is out of range");
    if (hasClock)
        setup.clock = clock;
    return setup;
}

void saveCounters(sim::StateWriter& writer, const SceneCounters& counters)
{
    for (const uint64_t count : {counters.steps, counters.wakeFailures, counters.refusedUpdates,
                                 counters.work.born, counters.work.dropped, counters.work.particleSteps,
                                 counters.work.neighborPairs, counters.work.subSteps, counters.work.clamped})
        writer.value(count);
    writer.value(counters.droppedTicks);
    writer.value(counters.work.debt);
}

SceneCounters restoreCounters(sim::StateReader& reader)
{
    SceneCounters counters;
    for (uint64_t* count : {&counters.steps, &counters.wakeFailures, &counters.refusedUpdates,
                            &counters.work.born, &counters.work.dropped, &counters.work.particleSteps,
                            &counters.work.neighborPairs, &counters.work.subSteps, &counters.work.clamped})
        *count = reader.value<uint64_t>();
    counters.droppedTicks = reader.value<base::Ticks>(0, INT64_MAX, "dropped time is negative");
    counters.work.debt = reader.value<base::Ticks>(0, kLatestTick, "time debt is out of range");
    return counters;
}

} // namespace

/// What was restored of a state, until all of it is known to be valid.
struct Scene::Restored
{
    explicit Restored(const Scene& scene)
        : instances(scene.memory_, scene.options_.maxInstances), rules(scene.memory_), dormant(scene.memory_),
          alarms(scene.memory_), active(scene.memory_), moved(scene.memory_), motions(scene.memory_),
          world(scene.schema_, scene.tasks_, scene.memory_, scene.world_.environment(),
                scene.options_.shareInstances)
    {
        world.setContact(scene.world_.contact());
    }

    base::ClockState clock;
    SceneCounters counters;
    uint64_t nextSerial = 0;
    IdTable<Instance> instances;
    std::pmr::vector<InstanceRule> rules; ///< ascending by instance
    activation::TimerQueue dormant;
    activation::TimerQueue alarms; ///< empty
    activation::ActiveList active;
    std::pmr::vector<LocalId> moved;
    std::pmr::vector<InMotion> motions;
    sim::World world;
};

/// Where the effect is, or one of the same content: a preset may have been loaded twice.
size_t Scene::placeOf(const Effects& effects, const sim::EffectDef& wanted)
{
    const auto isIt = [&wanted](const std::shared_ptr<const sim::EffectDef>& effect) {
        return effect.get() == &wanted ||
               (wanted.fingerprint != 0 && effect->fingerprint == wanted.fingerprint);
    };
    return size_t(std::find_if(effects.begin(), effects.end(), isIt) - effects.begin());
}

Scene::Effects Scene::effects() const
{
    Effects found;
    instances_.forEach([&](uint32_t, const Instance& instance) {
        if (placeOf(found, *instance.setup.effect) == found.size())
            found.push_back(instance.setup.effect);
    });
    return found;
}

void Scene::saveRules(sim::StateWriter& writer) const
{
    writer.value(options_.stepTicks);
    writer.vector(options_.environment.gravity);
    const sim::Environment& environment = world_.environment();
    writer.value(uint8_t((environment.hasGround ? kHasGround : 0) | (environment.field ? kHasField : 0)));
    if (environment.field)
        writer.value(environment.field->hash());
}

void Scene::saveInstances(sim::StateWriter& writer) const
{
    const Effects used = effects();
    writer.value(uint32_t(used.size()));
    for (const std::shared_ptr<const sim::EffectDef>& effect : used)
        writer.value(effect->fingerprint);
    writer.value(nextSerial_);
    instances_.save(writer, [&](const Instance& instance) {
        writer.value(uint32_t(placeOf(used, *instance.setup.effect)));
        writer.value(instance.serial);
        const bool isInWorld =
            instance.state != InstanceState::Dormant && instance.state != InstanceState::Finished;
        writer.value(isInWorld ? InstanceState::Active : instance.state); // states do not depend on cameras
        saveSetup(writer, instance.setup);
    });
}

/// Not a part of the simulation hash, because steps do not depend on masks and layers.
void Scene::saveDisplayRules(sim::StateWriter& writer) const
{
    std::pmr::vector<InstanceRule> rules(memory_);
    uint64_t revision = 0;
    rules_.copy(rules, revision);
    std::erase_if(rules, [](const InstanceRule& one) { return one.publicationsLeft > 0; });
    writer.value(uint32_t(rules.size()));
    for (const InstanceRule& one : rules) {
        writer.value(one.instance);
        writer.value(one.rule.mask);
        writer.value(one.rule.layer);
        writer.value(one.rule.sortKey);
    }
}

void Scene::restoreDisplayRules(sim::StateReader& reader, Restored& state) const
{
    const uint32_t count =
        reader.value<uint32_t>(0, options_.maxInstances, "the state has more masks than instances");
    for (uint32_t i = 0; i < count && reader.ok(); ++i) {
        const LocalId instance = reader.value<LocalId>();
        DisplayRule rule;
        rule.mask = reader.value<uint32_t>();
        rule.layer = reader.value<int32_t>(kLowestLayer, kHighestLayer, "a layer is out of range");
        rule.sortKey = reader.value<int32_t>();
        const bool isNext = state.rules.empty() || state.rules.back().instance < instance;
        reader.require(isNext && state.instances.find(instance) != nullptr,
                       "a visibility mask or layer is of an instance that the state does not have");
        if (reader.ok())
            state.rules.push_back({instance, rule});
    }
}

void Scene::saveMotions(sim::StateWriter& writer) const
{
    writer.value(uint32_t(motions_.size()));
    for (const InMotion& one : motions_) {
        writer.value(one.id);
        one.track->save(writer);
    }
}

void Scene::restoreMotions(sim::StateReader& reader, Restored& state) const
{
    const uint32_t count =
        reader.value<uint32_t>(0, options_.maxInstances, "the state has more motions than instances");
    for (uint32_t i = 0; i < count && reader.ok(); ++i) {
        const LocalId instance = reader.value<LocalId>();
        auto track = std::make_unique<MotionTrack>();
        track->restore(reader);
        const bool isNext = state.motions.empty() || state.motions.back().id < instance;
        const Instance* const found = state.instances.find(instance);
        reader.require(isNext && found && found->state != InstanceState::Finished,
                       "a motion is of an instance that the state does not have");
        if (reader.ok())
            state.motions.push_back({instance, std::move(track)});
    }
}

/// Not a part of the simulation hash, because steps do not depend on it.
void Scene::saveUserData(sim::StateWriter& writer) const
{
    instances_.forEach([&](uint32_t, const Instance& instance) { writer.value(instance.setup.userData); });
}

void Scene::restoreUserData(sim::StateReader& reader, Restored& state)
{
    std::as_const(state.instances).forEach([&](uint32_t index, const Instance&) {
        state.instances.at(index).setup.userData = reader.value<uint64_t>();
    });
}

void Scene::save(sim::StateWriter& writer)
{
    completeStep();
    settle(true);
    saveRules(writer);
    saveInstances(writer);
    saveMotions(writer);
    saveDisplayRules(writer);
    saveUserData(writer);
    const base::ClockState clock = clock_.state();
    writer.value(clock.steps);
    writer.value(clock.now);
    writer.value(clock.remainder);
    saveCounters(writer, counters_);
    world_.save(slotsBySerial(), writer);
}

uint64_t Scene::simulationHash()
{
    completeStep();
    settle(false);
    sim::StateHasher hasher;
    saveRules(hasher);
    saveInstances(hasher);
    if (!motions_.empty())
        saveMotions(hasher);
    hasher.value(clock_.simulated());
    hasher.value(world_.hash(slotsBySerial()));
    return hasher.hash();
}

base::Status Scene::restore(std::span<const std::byte> bytes, const FindEffect& findEffect)
{
    sim::StateReader reader(bytes);
    Restored state(*this);
    checkRules(reader);
    const Effects effects = restoreEffects(reader, findEffect);
    restoreInstances(reader, effects, state);
    restoreMotions(reader, state);
    restoreDisplayRules(reader, state);
    restoreUserData(reader, state);
    state.clock = restoreClock(reader);
    const SceneCounters counters = restoreCounters(reader);
    state.counters = counters;
    restoreWorld(reader, state);
    reader.require(reader.left() == 0, "the state goes on after its end");
    if (reader.ok())
        take(state);
    return reader.status();
}

void Scene::checkRules(sim::StateReader& reader) const
{
    sim::StateBuffer expected(memory_);
    saveRules(expected);
    std::vector<std::byte> found(expected.bytes().size());
    reader.values(std::span<std::byte>(found));
    if (!std::equal(found.begin(), found.end(), expected.bytes().begin()))
        reader.fail({base::Code::InvalidArgument,
                     "the state is of a scene with another stepTicks, gravity, hasGround or collision mesh"});
}

Scene::Effects Scene::restoreEffects(sim::StateReader& reader, const FindEffect& findEffect) const
{
    const Effects here = effects();
    const uint32_t count =
        reader.value<uint32_t>(0, options_.maxInstances, "the state has more effects than instances");
    Effects found;
    for (uint32_t i = 0; i < count && reader.ok(); ++i) {
        const uint64_t fingerprint = reader.value<uint64_t>();
        const auto isWanted = [&](const std::shared_ptr<const sim::EffectDef>& effect) {
            return effect->fingerprint == fingerprint;
        };
        const auto at = std::find_if(here.begin(), here.end(), isWanted);
        found.push_back(at != here.end() ? *at : findEffect(fingerprint));
        if (!found.back())
            reader.fail({base::Code::NotFound,
                         "the state needs a preset that is not loaded, or not as it was; load it first"});
    }
    return found;
}

base::ClockState Scene::restoreClock(sim::StateReader& reader) const
{
    base::ClockState clock;
    const base::Ticks step = options_.stepTicks;
    clock.steps = reader.value<int64_t>(0, kLatestTick / step, "the clock is out of range");
    clock.now = reader.value<base::Ticks>(clock.steps * step, clock.steps * step + step - 1 + kMaxDebt,
                                          "the clock is ahead of its steps or behind them");
    clock.remainder = reader.value<double>(-0.5, 0.5, "the clock's remainder is out of range");
    return clock;
}

void Scene::restoreInstances(sim::StateReader& reader, const Effects& effects, Restored& state) const
{
    state.nextSerial = reader.value<uint64_t>();
    state.instances.restore(reader, [&] {
        const uint32_t effect = reader.value<uint32_t>();
        Instance instance;
        instance.serial = reader.value<uint64_t>();
        instance.state = reader.value(InstanceState::Dormant, InstanceState::Finished,
                                      "the state of an instance is out of range");
        instance.setup = restoreSetup(reader);
        reader.require(effect < effects.size(), "an instance has no effect");
        reader.require(instance.serial < state.nextSerial, "an instance is from the future");
        if (reader.ok()) {
            instance.setup.effect = effects[effect];
            instance.policy = instance.setup.effect->catchUp();
            if (isBlown(*instance.setup.effect))
                instance.past.reset(new (std::nothrow) MotionHistory);
            measure(instance);
            if (instance.past) { // a state does not tell where it has been, and in which wind

                instance.past->forget();
                measure(instance);
            }
        }
        return instance;
    });
}

void Scene::restoreWorld(sim::StateReader& reader, Restored& state) const
{
    if (!reader.ok())
        return;
    std::vector<std::pair<uint64_t, uint32_t>> bySerial; // and index
    state.instances.forEach([&](uint32_t index, const Instance& instance) {
        bySerial.push_back({instance.serial, index});
    });
    std::sort(bySerial.begin(), bySerial.end());
    const auto isSame = [](const auto& a, const auto& b) { return a.first == b.first; };
    reader.require(std::adjacent_find(bySerial.begin(), bySerial.end(), isSame) == bySerial.end(),
                   "two instances were created at the same time");

    std::vector<sim::World::Entry> entries;
    std::vector<uint32_t> awake;
    for (const auto& [serial, index] : bySerial) {
        const Instance& instance = state.instances.at(index);
        if (instance.state == InstanceState::Active) {
            entries.push_back({instance.setup.effect, startOf(state.instances, index)});
            awake.push_back(index);
        }
        if (instance.setup.cameFrom)
            state.moved.push_back(state.instances.idAt(index));
        if (instance.state == InstanceState::Dormant)
            state.dormant.add({instance.setup.startTick, serial, index});
        if (instance.state == InstanceState::Finished)
            ++state.counters.finished;
    }
    std::vector<sim::Slot> slots(entries.size());
    state.world.restore(entries, reader, slots);
    state.active.reserve(bySerial.size());
    for (size_t i = 0; i < awake.size() && reader.ok(); ++i) {
        Instance& instance = state.instances.at(awake[i]);
        instance.slot = slots[i];
        state.active.insert(instance.serial, awake[i], instance.slot);
    }
}

/// Of all that is in the world, in order of creation.
std::vector<sim::Slot> Scene::slotsBySerial() const
{
    std::vector<std::pair<uint64_t, sim::Slot>> found;
    instances_.forEach([&](uint32_t, const Instance& instance) {
        if (instance.state != InstanceState::Dormant && instance.state != InstanceState::Finished)
            found.push_back({instance.serial, instance.slot});
    });
    std::sort(found.begin(), found.end());
    std::vector<sim::Slot> slots;
    for (const auto& [serial, slot] : found)
        slots.push_back(slot);
    return slots;
}

/// Room in a restored state, and in the lists that stay, for the reservations of the scene.
void Scene::reserveLists(Restored& state)
{
    const size_t most = std::min<size_t>(state.instances.count() + world_.reservations().reservedSets(),
                                         options_.maxInstances);
    state.instances.reserve(most);
    state.active.reserve(most);
    state.dormant.reserve(uint32_t(most), most);
    state.moved.reserve(most);
    waking_.reserve(most);
    state.alarms.reserve(uint32_t(most), most);
    arrived_.reserve(most);
    world_.reserveSwap(state.world);
}

/// Makes a restored state that of the scene, and shows it. Throws only while nothing has changed.
void Scene::take(Restored& state)
{
    const base::Ticks simulated = state.clock.steps * options_.stepTicks;
    // one snapshot at a time; lists that an open step reads get no room
    if (world_.isPublishing() || (world_.isStepping() && !reservations_.empty()))
        completeStep();
    if (!reservations_.empty())
        reserveLists(state);
    state.world.publish(state.active.slots(), ring_.beginWrite(simulated, options_.stepTicks));
    clock_.restore(state.clock);
    counters_ = state.counters;
    nextSerial_ = state.nextSerial;
    std::swap(instances_, state.instances);
    rules_.replace(state.rules);
    std::swap(dormant_, state.dormant);
    std::swap(active_, state.active);
    world_.swap(state.world);
    world_.setNow(simulated);
    forgetSight();
    std::swap(alarms_, state.alarms); // for its room
    published_ = stepEnd_ = simulated;
    if (events_)
        events_->clear();
    arrived_.clear();
    seeks_.clear();
    replaced_ = hasStarted_ = false;
    std::swap(moved_, state.moved);
    {
        std::lock_guard lock(presentation_);
        std::swap(motions_, state.motions);
    }
    preferring_ = {};
    hints_.store({}, std::memory_order_relaxed);
    instances_.forEach([&](uint32_t, const Instance& instance) {
        if (instance.state != InstanceState::Finished)
            countHints(instance, 1);
    });
    showsNothing_.store(false, std::memory_order_release);
    std::lock_guard lock(presentation_);
    ring_.publish();
    ring_.forgetOlder();
    show(simulated, clock_.interpolation());
}

} // namespace fx::scene
