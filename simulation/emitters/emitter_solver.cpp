#include "simulation/emitters/emitter_solver.h"

#include "foundation/random/philox.h"
#include "simulation/parallel.h"
#include "simulation/particles/birth_kernel.h"
#include "simulation/particles/tile_step.h"

#include <algorithm>
#include <atomic>
#include <optional>

namespace fx::sim {

namespace {

constexpr uint32_t kBirthBatch = 4096;   // births that are made at once
constexpr uint32_t kMinBirths = 512;     // fewer cost less than handing them to another thread
constexpr uint32_t kMinSteppedTiles = 4; // likewise
constexpr uint64_t kMostLapsPerStep = 4; // of the ring; more births in a step cannot be told apart anyway

glm::vec3 pullOf(const EmitterDef& def, const StepContext& context)
{
    const float drag = def.forces.drag > 0.0f ? std::min(def.forces.drag, 1e6f) : 0.0f;
    return def.forces.gravity * context.gravity + drag * (context.wind + def.forces.wind);
}

} // namespace

bool EmitterDef::collides() const
{
    return forces.bounce >= 0.0f ||
           std::any_of(modules.begin(), modules.end(), [](const auto& op) { return op->collides(); });
}

std::unique_ptr<Solver> EmitterDef::create(const base::SnapshotSchema& schema, const Quality&,
                                           std::pmr::memory_resource* memory) const
{
    const EmitterKinds kinds{schema.find(base::kBlobKind.name), schema.find(base::kParticleKind.name),
                             schema.find(base::kRibbonKind.name), schema.find(base::kLightKind.name),
                             schema.find(base::kGpuParticleKind.name)};
    return std::make_unique<EmitterSolver>(*this, kinds, memory);
}

EmitterSolver::EmitterSolver(const EmitterDef& def, const EmitterKinds& kinds,
                             std::pmr::memory_resource* memory)
    : def_(def), kinds_(kinds), shared_(def.program.of(def)), program_(*shared_),
      schedule_(def.emission, memory), store_(program_, memory), interest_(def.events), lights_(memory),
      rowsByBirth_(memory)
{
    if (def.trail.lifetime > 0.0f)
        trails_.emplace(def.trail, store_.capacity(), memory);
    if (def.light.given)
        lights_.resize(store_.capacity());
    if (def.look.kind == Appearance::Medium)
        rowsByBirth_.resize(store_.capacity());
    if (program_.gpu && kinds.gpuParticle != base::kNoKind)
        schedule_.setLog(&gpu_.emplace(program_, memory).log());
}

void EmitterSolver::begin(const StepContext& context)
{
    schedule_.setPhase(
        base::randomUnit4(context.seed, context.solverIndex, 0, base::RandomPurpose::BirthPhase)[0]);
    conditions_ = conditionsOf(context);
    motionBegin_ = 0;
    varied_ = false;
    started_ = true;
    if (gpu_)
        gpu_->clear(0, 0, conditions_.pull);
}

EmitterSolver::Conditions EmitterSolver::conditionsOf(const StepContext& context) const
{
    return {pullOf(def_, context), context.parameters->intensity, context.parameters->emitting};
}

/// When gravity or wind change, motion goes on from where it has come to.
void EmitterSolver::heedConditions(const StepContext& context)
{
    const Conditions conditions = conditionsOf(context);
    varied_ = varied_ || !(conditions == conditions_);
    const bool goesOn = !program_.ballistic || conditions.pull == conditions_.pull;
    conditions_.intensity = conditions.intensity;
    conditions_.emitting = conditions.emitting;
    if (goesOn)
        return;
    if (gpu_)
        gpu_->setPull(now_, conditions.pull);
    if (!gpu_ || !gpu_->isOn())
        restartMotion(lookJob(), store_);
    store_.placed = true;
    motionBegin_ = now_;
    conditions_ = conditions;
}

void EmitterSolver::step(const StepContext& context)
{
    tasks_ = context.tasks;
    now_ = context.tick;
    if (!started_)
        begin(context);
    key_ = {context.seed, context.solverIndex};
    schedule_.setSeed(context.seed, context.solverIndex);
    if (gpu_ && gpu_->isOn() && !context.gpuParticles)
        leaveGpu();
    heedConditions(context);
    if (gpu_ && gpu_->isOn())
        return stepOnGpu(context);
    const base::Ticks end = context.tick + context.stepTicks;
    const uint64_t droppedBefore = dropped_;
    if (isLinked()) {
        stepWithEvents(context);
    } else {
        giveBirth(context, context.tick, end);
        if (!program_.ballistic)
            move(context);
    }
    now_ = end;
    if (trails_)
        trails_->follow(lookJob(), context.tick, end);
    store_.retire(now_);
    const uint64_t window = std::min<uint64_t>(store_.next() - store_.front(), store_.capacity());
    context.counters->particleSteps += window;
    highWater_ = std::max(highWater_, uint32_t(window));
    offerToGpu(droppedBefore, context.gpuParticles);
}

void EmitterSolver::giveBirth(const StepContext& context, base::Ticks from, base::Ticks to)
{
    const std::span<Birth> room = context.scratch->allocate<Birth>(std::min(kBirthBatch, store_.capacity()));
    const BirthWindow window{from, to, double(context.parameters->intensity), context.parameters->emitting};
    uint64_t left = kMostLapsPerStep * std::max(store_.capacity(), kBirthBatch);
    const BirthCount count = schedule_.advance(
        window, room, left, [&](std::span<const Birth> births) { storeBatch(context, births); });
    context.counters->born += count.total;
    context.counters->dropped += count.total - count.stored;
    dropped_ += count.total - count.stored;
    store_.advance(count.total - count.stored);
}

void EmitterSolver::storeBatch(const StepContext& context, std::span<const Birth> births)
{
    std::atomic<uint32_t> living{0};
    parallelRows(*context.tasks, uint32_t(births.size()), kMinBirths, [&](uint32_t begin, uint32_t end) {
        living += storeBirths(program_, {context.seed, context.solverIndex},
                              births.subspan(begin, end - begin), store_);
    });
    const uint64_t refused = births.size() - living;
    context.counters->dropped += refused;
    dropped_ += refused;
    store_.advance(births.size());
}

/// @param firstIndex only particles from it on move @param room receives what happens to them; null: nobody
/// asks
void EmitterSolver::move(const StepContext& context, uint64_t firstIndex, EventRoom* room)
{
    TileStep step(program_, context);
    std::optional<EventWatch> watch;
    if (room)
        step.watchBy(&watch.emplace(interest_, *room));
    step.onlyFrom(firstIndex);
    const RowWindow rows = store_.window();
    const uint32_t tiles = (rows.count + kTileRows - 1) / kTileRows;
    parallelRows(*context.tasks, tiles, kMinSteppedTiles, [&](uint32_t begin, uint32_t end) {
        step.run(store_, begin * kTileRows, std::min(end * kTileRows, rows.count));
    });
}

bool EmitterSolver::finished(base::Ticks tick) const
{
    const bool isEmpty =
        gpu_ && gpu_->isOn() ? schedule_.exhausted(tick) && gpu_->isEmpty(key_, now_) : store_.empty();
    return isEmpty && !(trails_ && !trails_->empty()) && schedule_.exhausted(tick) &&
           !interest_.in(EventKind::Host);
}

/// True when the ring is so large that no birth can ever find its row taken.
bool EmitterSolver::neverDrops(double intensity) const
{
    const Emission& emission = def_.emission;
    if (!emission.bursts.empty())
        return false;
    double most = 0;
    for (size_t i = 0; i <= base::kCurveSamples; ++i)
        most = std::max(most, double(emission.rateOverTime.at(float(i) / float(base::kCurveSamples))[0]));
    const double born = double(emission.rate) * most * intensity * base::toSeconds(program_.longestLife);
    return born * 1.001 + 2.0 < double(store_.capacity());
}

bool EmitterSolver::canSeek(const StepContext& context, base::Ticks tick) const
{
    const bool isForwards = tick >= now_ || !started_;
    return program_.ballistic && !isLinked() && !trails_ &&
           (isForwards || (!varied_ && conditionsOf(context) == conditions_));
}

void EmitterSolver::seek(const StepContext& context, base::Ticks tick)
{
    tasks_ = context.tasks;
    key_ = {context.seed, context.solverIndex};
    if (gpu_ && gpu_->isOn())
        leaveGpu();
    if (!started_ || tick < now_) {
        schedule_ = BirthSchedule(def_.emission, rowsByBirth_.get_allocator().resource());
        if (gpu_)
            schedule_.setLog(&gpu_->log());
        store_.clear(0);
        store_.placed = program_.stores[stored::X];
        now_ = 0;
        begin(context);
    }
    schedule_.setSeed(context.seed, context.solverIndex);
    heedConditions(context);
    const uint64_t droppedBefore = dropped_;
    base::Ticks from = now_;
    if (neverDrops(double(context.parameters->intensity))) {
        // Whoever was born before then is dead.
        const base::Ticks dead = tick - program_.longestLife - base::kTicksPerSecond;
        if (dead > from) {
            const BirthWindow past{from, dead, double(context.parameters->intensity),
                                   context.parameters->emitting};
            store_.clear(store_.next() + schedule_.advance(past, {}).total);
            from = dead;
        }
    }
    for (const base::Ticks part = base::kTicksPerSecond / 60; from < tick; from += part)
        giveBirth(context, from, std::min(from + part, tick));
    now_ = tick;
    store_.retire(now_);
    offerToGpu(droppedBefore, false);
}

void EmitterSolver::save(StateWriter& writer) const
{
    writer.value(now_);
    writer.flag(started_);
    writer.value(motionBegin_);
    writer.vector(conditions_.pull);
    writer.value(conditions_.intensity);
    writer.flag(conditions_.emitting);
    writer.flag(varied_);
    if (interest_.in(EventKind::Host))
        writer.value(hostEvents_);
    schedule_.save(writer);
    if (gpu_ && gpu_->isOn())
        saveFromGpu(writer);
    else
        store_.save(writer, now_);
    if (trails_)
        trails_->save(writer);
}

void EmitterSolver::restore(StateReader& reader)
{
    now_ = reader.value<base::Ticks>(0, kForever, "an emitter's clock is out of range");
    started_ = reader.flag();
    motionBegin_ = reader.value<base::Ticks>(0, now_, "an emitter's clock is out of range");
    conditions_.pull = reader.vector();
    conditions_.intensity = reader.value<float>();
    conditions_.emitting = reader.flag();
    varied_ = reader.flag();
    if (interest_.in(EventKind::Host))
        hostEvents_ = reader.value<uint64_t>();
    schedule_.restore(reader);
    store_.restore(reader, now_);
    listenAgain();
    if (trails_)
        trails_->restore(reader);
}

} // namespace fx::sim
