#include "simulation/emitters/emitter_solver.h"

#include "foundation/memory/out_of_memory.h"
#include "foundation/random/philox.h"
#include "foundation/snapshot/material_kind.h"
#include "foundation/tasks/parallel_rows.h"
#include "simulation/emitters/pools/spawn_batch.h"
#include "simulation/particles/birth_kernel.h"
#include "simulation/particles/tile_step.h"

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <optional>
#include <utility>

namespace fx::sim {

namespace {

constexpr uint32_t kBirthBatch = 4096;   // births that are made at once
constexpr uint32_t kMinBirths = 512;     // fewer cost less than handing them to another thread
constexpr uint32_t kMinSteppedTiles = 4; // likewise
constexpr uint64_t kMaxLapsPerStep = 4;  // of the ring; more births in a step cannot be told apart anyway

glm::vec3 pullOf(const EmitterDef& def, const StepContext& context)
{
    const float drag = def.forces.drag > 0.0f ? std::min(def.forces.drag, 1e6f) : 0.0f;
    return def.forces.gravity * context.gravity + drag * (context.wind + def.forces.wind);
}

/// Names what there was no memory for, without any.
base::OutOfMemory outOfMemory(const EmitterDef& def)
{
    std::array<char, 512> text;
    std::snprintf(text.data(), text.size(),
                  "the allocator returned null for the emitter \"%.128s\", whose maxParticles %u take %llu "
                  "bytes an instance; lower maxParticles%s",
                  def.name.empty() ? "(unnamed)" : def.name.c_str(), def.maxParticles,
                  static_cast<unsigned long long>(def.bytes()),
                  def.trail.lifetime > 0.0f ? " or maxPoints of its trail" : "");
    return base::OutOfMemory(text.data());
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
    const EmitterKinds kinds{schema.find(base::kBlobKind.name),        schema.find(base::kParticleKind.name),
                             schema.find(base::kRibbonKind.name),      schema.find(base::kLightKind.name),
                             schema.find(base::kGpuParticleKind.name), schema.find(base::kMaterialKind.name)};
    try {
        return std::make_unique<EmitterSolver>(*this, kinds, memory);
    } catch (const std::bad_alloc&) {
        throw outOfMemory(*this);
    }
}

uint64_t EmitterDef::bytes() const
{
    return EmitterSolver::bytesOf(*this, *program.of(*this));
}

double EmitterDef::workOf(const StepLoad& load) const
{
    const double followed = trail.lifetime > 0.0f ? emitter_work::kTrail : 0.0;
    return load.births * emitter_work::kBirth + load.events * emitter_work::kEvent +
           load.alive * (stepWork(*program.of(*this)) + followed);
}

uint64_t EmitterSolver::bytesOf(const EmitterDef& def, const ParticleProgram& program)
{
    const uint64_t rows = def.maxParticles;
    uint64_t bytes = ParticleStore::bytesOf(program, def.maxParticles);
    if (def.trail.lifetime > 0.0f)
        bytes += RibbonStore::bytesOf(def.trail, def.maxParticles);
    if (def.light.given)
        bytes += rows * sizeof(Light);
    if (def.appearance.kind == AppearanceKind::Medium)
        bytes += rows * sizeof(uint32_t);
    if (def.hasDetail())
        bytes += MaterialCoordinates::bytesOf(def.maxParticles);
    return bytes;
}

EmitterSolver::EmitterSolver(const EmitterDef& def, const EmitterKinds& kinds,
                             std::pmr::memory_resource* memory)
    : EmitterSolver(def, kinds, def.program.of(def), memory)
{}

EmitterSolver::EmitterSolver(const EmitterDef& def, const EmitterKinds& kinds,
                             std::shared_ptr<const ParticleProgram> program,
                             std::pmr::memory_resource* memory)
    : def_(def), program_(*program), kinds_(kinds), store_(program_, memory), schedule_(def.emission, memory),
      shared_(std::move(program)), interest_(def.events, program_.longestLife), lights_(memory),
      rowsByBirth_(memory), stepWork_(sim::stepWork(program_))
{
    const bool isSmall = store_.capacity() <= kFewRows && !program_.gpu;
    const bool isDrawn =
        def.appearance.kind == AppearanceKind::Sprite || def.appearance.kind == AppearanceKind::Mesh;
    bornWithMany_ = isSmall && program_.ballistic && !def.inWorld && !isLinked() &&
                    !(def.trail.lifetime > 0.0f) && !def.hasDetail();
    publishesWithMany_ = isSmall && isDrawn && !def.inWorld && kinds.particle != base::kNoKind &&
                         !(def.trail.lifetime > 0.0f) && !def.light.given;
    poolable_ = isPoolable();
    if (def.trail.lifetime > 0.0f)
        trails_.emplace(def.trail, store_.capacity(), memory);
    isDivided_ = isLinked() || trails_ || store_.capacity() > kFewRows;
    if (def.hasDetail())
        detail_.emplace(def, store_.capacity(), memory);
    if (def.inWorld)
        space_.emplace();
    if (def.light.given)
        lights_.resize(store_.capacity());
    if (def.appearance.kind == AppearanceKind::Medium)
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
    if (detail_)
        detail_->begin(0, 0);
    if (gpu_)
        gpu_->clear({context.seed, context.solverIndex}, 0, 0, conditions_.pull);
}

EmitterSolver::Conditions EmitterSolver::conditionsOf(const StepContext& context) const
{
    return {pullOf(def_, context), context.parameters->intensity, context.parameters->emitting};
}

/// When gravity or wind change, motion goes on from where it has come to.
void EmitterSolver::applyConditions(const StepContext& context)
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
        restartMotion(appearanceJob(), store_);
    store_.placed = true;
    motionBegin_ = now_;
    conditions_ = conditions;
}

bool EmitterSolver::goOn(const StepContext& context, base::WorkBudget& work)
{
    const bool begins = !isOpen(context);
    if (begins)
        leavePool();
    if (!space_)
        return goOnHere(context, work);
    if (begins && !started_)
        space_->begin(context.placement);
    else if (begins && context.tick != now_) // the path during the skipped time is unknown
        space_->jumpTo(context.placement);
    if (begins)
        space_->moveTo(context.placement, context.moveShare);
    return inHome(context, [&](const StepContext& home) { return goOnHere(home, work); });
}

/// In the space of the particles.
bool EmitterSolver::goOnHere(const StepContext& context, base::WorkBudget& work)
{
    if (!isOpen(context))
        openStep(context);
    if (gpu_ && gpu_->isOn()) {
        open_.tick = -1;
        forgetRefusals();
        stepOnGpu(context);
        return true;
    }
    if (open_.part != StepPart::Follow) {
        if (!(isLinked() ? stepWithEvents(context, work) : stepAlone(context, work)))
            return false;
        now_ = context.tick + context.stepTicks;
        open_.part = StepPart::Follow;
        open_.row = 0;
    }
    if (trails_ && !trails_->follow(appearanceJob(), {context.tick, now_}, open_.row, work))
        return false;
    closeStep(context);
    return true;
}

void EmitterSolver::openStep(const StepContext& context)
{
    schedule_.passTo(now_);
    tasks_ = context.tasks;
    now_ = context.tick;
    if (!started_)
        begin(context);
    key_ = {context.seed, context.solverIndex};
    schedule_.setSeed(context.seed, context.solverIndex);
    const bool isWanted = context.gpuParticles && gpu_ && !gpu_->asksTooMuch(context);
    if (gpu_ && gpu_->isOn() && !isWanted)
        leaveGpu();
    applyConditions(context);
    if (gpu_)
        gpu_->noteStep(context);
    open_ = {};
    openBirths(context.tick);
    open_.isWanted = isWanted;
    open_.droppedBefore = dropped_;
    open_.tick = context.tick;
}

void EmitterSolver::closeStep(const StepContext& context)
{
    open_.tick = -1;
    if (detail_)
        detail_->follow(appearanceJob(), context);
    if (!context.spawnBatch || !context.spawnBatch->waitsFor(*this))
        endStep(*context.counters);
    offerToGpu(open_.droppedBefore, open_.isWanted);
}

bool EmitterSolver::stepAlone(const StepContext& context, base::WorkBudget& work)
{
    if (open_.part != StepPart::Move) {
        if (!giveBirth(context, context.tick + context.stepTicks, birthRoom(context), work))
            return false;
        open_.part = StepPart::Move;
        open_.row = 0;
    }
    if (!program_.ballistic)
        return move(context, work);
    const uint32_t left = store_.rowsInUse() - open_.row; // all that there is to do for them is to count
    const uint32_t rows = work.affords(stepWork_, left);
    work.spend(uint64_t(stepWork_ * double(rows)));
    open_.row += rows;
    return rows == left;
}

/// Whether births wait for those of others.
bool EmitterSolver::joins(const StepContext& context) const
{
    return context.spawnBatch && bornWithMany_ && store_.placed == program_.stores[stored::X];
}

std::span<Birth> EmitterSolver::birthRoom(const StepContext& context) const
{
    return context.scratch->allocate<Birth>(std::min(kBirthBatch, store_.capacity()));
}

void EmitterSolver::openBirths(base::Ticks from)
{
    open_.reached = from;
    open_.left = kMaxLapsPerStep * std::max(store_.capacity(), kBirthBatch);
    open_.asked = open_.refused = 0;
}

/// Makes births from open_.reached to `to`. @return whether all are made
bool EmitterSolver::giveBirth(const StepContext& context, base::Ticks to, std::span<Birth> room,
                              base::WorkBudget& work)
{
    const auto windowFrom = [&](base::Ticks from) {
        return BirthWindow{from, to, double(context.parameters->intensity), context.parameters->emitting};
    };
    if (to <= fullUntil_ && open_.asked == 0) {
        const uint64_t refused = schedule_.advance(windowFrom(open_.reached), {}).total;
        context.counters->born += refused;
        refuse(refused, *context.counters);
        store_.advance(refused);
        open_.reached = to;
        return true;
    }
    while (open_.reached < to) {
        if (work.isSpent())
            return false;
        const uint64_t droppedBefore = dropped_;
        const uint32_t wanted = std::max(work.affords(emitter_work::kBirth, UINT32_MAX), kBirthBatch);
        const BirthCount count =
            schedule_.advance(windowFrom(open_.reached), room, open_.left, wanted, open_.reached,
                              [&](std::span<const Birth> births) { storeBatch(context, births); });
        context.counters->born += count.total;
        context.counters->dropped += count.total - count.stored;
        open_.left -= count.stored;
        open_.asked += count.stored;
        open_.refused += dropped_ - droppedBefore;
        dropped_ += count.total - count.stored;
        store_.advance(count.total - count.stored);
        if (isDivided_)
            work.spend(uint64_t(emitter_work::kBirth * double(count.stored)));
    }
    noteRefusals();
    return true;
}

/// Once all rows have refused a birth, one after the other, none is free before the first particle in them
/// dies: until then births need only be counted.
void EmitterSolver::noteRefusals()
{
    fullUntil_ = 0;
    refusedInRow_ = open_.refused == open_.asked ? refusedInRow_ + open_.refused : 0;
    if (refusedInRow_ < store_.capacity() || program_.mortal || (gpu_ && gpu_->isOn()))
        return;
    refusedInRow_ = 0;
    fullUntil_ = store_.allLiveUntil();
}

void EmitterSolver::storeBatch(const StepContext& context, std::span<const Birth> births)
{
    if (joins(context) && births.size() <= SpawnBatch::kMaxDeferredBirths) {
        context.spawnBatch->wait(*this, context, births);
        store_.advance(births.size());
        return;
    }
    if (context.spawnBatch && context.spawnBatch->waitsFor(*this))
        context.spawnBatch->makeBirths(); // they come first
    std::atomic<uint32_t> living{0};
    parallelRows(*context.tasks, uint32_t(births.size()), kMinBirths, [&](uint32_t begin, uint32_t end) {
        living += storeBirths(program_, {context.seed, context.solverIndex},
                              births.subspan(begin, end - begin), store_);
    });
    if (space_ && !isLinked())
        carryBirths(context, births);
    refuse(births.size() - living, *context.counters);
    store_.advance(births.size());
}

/// @param firstIndex only particles from it on move @param room receives their events; null: none are
///             collected
/// @return whether all have moved, those of the rows before open_.row among them
bool EmitterSolver::move(const StepContext& context, base::WorkBudget& work, uint64_t firstIndex,
                         EventRoom* room)
{
    const RowWindow rows = store_.window();
    const uint32_t left = (rows.count - open_.row + kTileRows - 1) / kTileRows;
    const uint32_t tiles = work.affords(stepWork_ * kTileRows, left);
    if (tiles > 0) {
        TileStep step(program_, context);
        std::optional<EventWatch> watch;
        if (room)
            step.watchBy(&watch.emplace(def_, interest_, store_, *room));
        step.onlyFrom(firstIndex);
        parallelRows(*context.tasks, tiles, kMinSteppedTiles, [&](uint32_t begin, uint32_t end) {
            step.run(store_, open_.row + begin * kTileRows,
                     std::min(open_.row + end * kTileRows, rows.count));
        });
        work.spend(uint64_t(stepWork_ * double(tiles) * kTileRows));
    }
    open_.row += tiles * kTileRows;
    return tiles == left;
}

bool EmitterSolver::finished(base::Ticks tick) const
{
    if (pool_)
        return false; // it has particles
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
    catchUpWithPool();
    const bool isForwards = tick >= now_ || !started_;
    if (isForwards && restsThrough(context, tick))
        return true;
    if (!program_.ballistic || isLinked() || trails_ || detail_) // coordinates are known from steps alone
        return false;
    if (!space_)
        return isForwards || (!varied_ && conditionsOf(context) == conditions_);
    if (!started_)
        return true;
    // Where the host has moved the instance, only steps know the way.
    return space_->stands(context.placement) && (isForwards || !varied_) &&
           inHome(context,
                  [&](const StepContext& home) { return isForwards || conditionsOf(home) == conditions_; });
}

bool EmitterSolver::restsThrough(const StepContext& context, base::Ticks tick) const
{
    return context.parameters->intensity == conditions_.intensity &&
           context.parameters->emitting == conditions_.emitting && restsUntil(now_) > now_ &&
           tick <= restsUntil(now_);
}

base::Ticks EmitterSolver::restsUntil(base::Ticks tick) const
{
    if (pool_)
        return tick; // it has particles
    const bool hasRows = !(gpu_ && gpu_->isOn());
    const bool isEmpty = hasRows && store_.empty() && !(trails_ && !trails_->empty());
    if (!isEmpty || !started_ || tick != now_ || interest_.in(EventKind::Host))
        return tick;
    return std::max(tick, schedule_.quietUntil(tick, double(conditions_.intensity), conditions_.emitting));
}

void EmitterSolver::seek(const StepContext& context, base::Ticks tick)
{
    leavePool();
    if (!space_)
        return seekHere(context, tick);
    if (!started_ || tick < now_)
        space_->begin(context.placement);
    space_->moveTo(context.placement);
    inHome(context, [&](const StepContext& home) { seekHere(home, tick); });
}

void EmitterSolver::seekHere(const StepContext& context, base::Ticks tick)
{
    forgetRefusals();
    tasks_ = context.tasks;
    schedule_.passTo(now_);
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
    applyConditions(context);
    const uint64_t droppedBefore = dropped_;
    base::Ticks from = now_;
    if (neverDrops(double(context.parameters->intensity))) {
        // Particles born before then are dead.
        const base::Ticks dead = tick - lifetimeOf(double(context.parameters->intensity));
        if (dead > from) {
            const BirthWindow past{from, dead, double(context.parameters->intensity),
                                   context.parameters->emitting};
            store_.clear(store_.next() + schedule_.advance(past, {}).total);
            from = dead;
        }
    }
    const base::Ticks part =
        restsUntil(from) >= tick ? tick - from : base::kTicksPerSecond / 60; // a rest is one window
    open_ = {};
    base::WorkBudget unlimited;
    for (const std::span<Birth> room = birthRoom(context); from < tick; from += part) {
        openBirths(from);
        giveBirth(context, std::min(from + part, tick), room, unlimited);
    }
    now_ = tick;
    store_.retire(now_);
    offerToGpu(droppedBefore, false);
}

} // namespace fx::sim
