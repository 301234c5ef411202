#include "simulation/gpu_programs/gpu_emitter.h"

#include "foundation/random/philox.h"
#include "foundation/snapshot/gpu_particles.h"
#include "simulation/particles/row_publication.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

namespace fx::sim {

namespace {

template <class T>
void put(std::byte*& io, std::span<const T> values)
{
    if (values.empty())
        return; // they may lie nowhere
    std::memcpy(io, values.data(), values.size_bytes());
    io += values.size_bytes();
}

} // namespace

GpuEmitter::GpuEmitter(const ParticleProgram& program, std::pmr::memory_resource* memory)
    : program_(program), rows_(program.gpu->rows), window_(longestKept(program)),
      steps_(program.gpu->features.steps), kills_(program.gpu->kills),
      dependsOnHost_(program.gpu->dependsOnHost), log_(memory), stepLog_(memory), conditions_(memory)
{
    conditions_.reserve(base::kMaxGpuConditions);
    conditions_.push_back({0, glm::vec3(0.0f)});
    for (const base::GpuModuleUse& use : program.gpu->features.modules) {
        if (use.module < base::kFirstGpuContact)
            continue;
        const bool isGround = use.module == base::GpuModule::Bounce || use.module == base::GpuModule::Ground;
        meetsGround_ = meetsGround_ || isGround;
        meetsOthers_ = meetsOthers_ || !isGround;
    }
}

void GpuEmitter::clear(const BirthKey& key, base::Ticks now, uint64_t next, const glm::vec3& pull)
{
    log_.clear(next);
    stepLog_.clear(key.seed, key.solver);
    conditions_.assign(1, {now, pull});
    known_ = now;
    dropped_ = -1;
    on_ = false;
}

void GpuEmitter::noteStep(const StepContext& context)
{
    if (!steps_)
        return;
    if (asksTooMuch(context))
        known_ = context.tick + context.stepTicks;
    if (!on_ && stepLog_.runs() > 2 * base::kMaxGpuStepRuns) { // it would not be of use anyway
        stepLog_.clear(context.seed, context.solverIndex);
        known_ = context.tick;
    }
    const InstanceParameters& wanted = *context.parameters;
    stepLog_.add(context.tick, context.stepTicks, log_.next(),
                 {context.gravity, context.wind, context.groundHeight, wanted.intensity, wanted.emitting});
}

void GpuEmitter::setPull(base::Ticks now, const glm::vec3& pull)
{
    if (conditions_.back().begin == now)
        conditions_.back().pull = pull;
    else
        conditions_.push_back({now, pull});
}

void GpuEmitter::forget(base::Ticks now)
{
    const base::Ticks oldest = now - window_;
    log_.forget(oldest);
    stepLog_.forget(oldest);
    size_t gone = 0;
    while (gone + 1 < conditions_.size() && conditions_[gone + 1].begin <= oldest)
        ++gone;
    conditions_.erase(conditions_.begin(), conditions_.begin() + std::ptrdiff_t(gone));
}

bool GpuEmitter::mayGoOn(base::Ticks now) const
{
    return surelyFits() && log_.runs() <= base::kMaxGpuRuns &&
           conditions_.size() <= base::kMaxGpuConditions && stepLog_.runs() <= base::kMaxGpuStepRuns &&
           stepLog_.stepsSince(now - window_) <= base::kMaxGpuSteps;
}

bool GpuEmitter::mayBegin(base::Ticks now) const
{
    const base::Ticks oldest = now - window_;
    const bool isKnown = (known_ == 0 || known_ < oldest) && dropped_ < std::max<base::Ticks>(oldest, 0);
    // With some room, so that it does not come and go with every step.
    return isKnown && surelyFits() && 4 * log_.runs() <= 3 * base::kMaxGpuRuns &&
           4 * conditions_.size() <= 3 * base::kMaxGpuConditions &&
           4 * stepLog_.runs() <= 3 * base::kMaxGpuStepRuns &&
           4 * stepLog_.stepsSince(oldest) <= 3 * base::kMaxGpuSteps;
}

base::Ticks GpuEmitter::lastDeath(const BirthKey& key) const
{
    if (deathsOf_ == log_.next())
        return lastDeath_;
    base::Ticks last = 0;
    std::array<base::Ticks, kTileRows> ticks;
    for (uint64_t at = log_.front(); at < log_.next(); at += kTileRows) {
        const auto size = size_t(std::min<uint64_t>(log_.next() - at, kTileRows));
        log_.ticksOf(at, std::span(ticks).first(size));
        for (size_t i = 0; i < size; ++i) {
            float perLife = program_.constant[stored::PerLife];
            if (program_.stores[stored::PerLife])
                perLife = perLifeOf(program_.def.lifetime.at(
                    base::randomUnit4(key.seed, key.solver, at + i, base::RandomPurpose::Life)[0]));
            last = std::max(last, ticks[i] + base::toTicks(1.0 / double(perLife)));
        }
    }
    deathsOf_ = log_.next();
    return lastDeath_ = last;
}

bool GpuEmitter::isEmpty(const BirthKey& key, base::Ticks now) const
{
    return log_.empty() || lastDeath(key) < now;
}

AppearanceJob GpuEmitter::rebuild(const BirthKey& key, base::Ticks now, ParticleStore& store) const
{
    ReplayInput in{
        key,         log_.front(),
        log_.next(), [this](uint64_t first, std::span<base::Ticks> out) { log_.ticksOf(first, out); },
        conditions_, now,
        store.placed};
    if (!steps_)
        return replayBirths(program_, in, store);
    std::vector<ReplayStep> steps;
    stepLog_.forEachSince(now - window_, [&](const LoggedStep& step) {
        const StepConditions& c = step.conditions;
        steps.push_back({step.begin, step.end, c.gravity, c.wind, c.ground});
    });
    in.steps = steps;
    return replaySteps(program_, in, store);
}

float GpuEmitter::oldestAge(base::Ticks now) const
{
    const base::Ticks oldest = log_.empty() ? 0 : now - log_.tickOf(log_.front());
    return float(base::toSeconds(std::min(oldest, program_.longestLife)));
}

ConditionsRange GpuEmitter::conditionsRange(base::Ticks now) const
{
    const EmitterSettings& def = program_.def;
    const float drag = def.forces.drag > 0.0f ? std::min(def.forces.drag, 1e6f) : 0.0f;
    ConditionsRange out;
    out.low = glm::vec3(kFarAway);
    out.high = -out.low;
    out.lowGround = kFarAway;
    out.highGround = -kFarAway;
    stepLog_.forEachRun([&](const StepConditions& c) {
        const glm::vec3 pull = def.forces.gravity * c.gravity + drag * (c.wind + def.forces.wind);
        out.low = glm::min(out.low, pull);
        out.high = glm::max(out.high, pull);
        out.lowGround = std::min(out.lowGround, c.ground);
        out.highGround = std::max(out.highGround, c.ground);
        out.strongest.gravity = std::max(out.strongest.gravity, glm::length(c.gravity));
        out.strongest.wind = std::max(out.strongest.wind, glm::length(c.wind));
    });
    out.strongest.seconds = oldestAge(now);
    out.meetsGround = meetsGround_;
    out.meetsOthers = meetsOthers_;
    return out;
}

base::Bounds GpuEmitter::bounds(base::Ticks now, float secondsBack) const
{
    if (steps_) {
        ConditionsRange met = conditionsRange(now);
        met.secondsBack = secondsBack;
        return boundsOfStepped(program_.def, met);
    }
    const float seconds = oldestAge(now);
    glm::vec3 low = conditions_[0].pull, high = low;
    for (const MotionCondition& condition : conditions_) {
        low = glm::min(low, condition.pull);
        high = glm::max(high, condition.pull);
    }
    return boundsOfAll(program_.def, low, high, seconds, secondsBack);
}

void GpuEmitter::publish(const base::GroupInfo& base, base::KindId kind, const BirthKey& key, base::Ticks now,
                         base::FrameSnapshot& snapshot) const
{
    constexpr size_t kFewRuns = 16; // room changes rarely
    const size_t room = steps_ ? std::bit_ceil(std::max(stepLog_.runs(), kFewRuns)) : 0;
    base::SnapshotGroup& group =
        snapshot.addGroup(kind, base::kMaxGpuWords + room * sizeof(base::GpuStepRun) / 8);
    std::array<base::GpuBirthRun, base::kMaxGpuRuns> runs;
    std::array<base::GpuCondition, base::kMaxGpuConditions> conditions;
    base::GpuParticleMoment moment{};
    moment.seed = key.seed;
    moment.next = log_.next();
    moment.now = now;
    moment.solver = key.solver;
    moment.rows = rows_;
    moment.nextRow = uint32_t(log_.next() % rows_);
    moment.window = count();
    moment.runs = uint32_t(log_.runs());
    moment.conditions = uint32_t(conditions_.size());
    moment.stepRuns = uint32_t(stepLog_.runs());
    log_.publish(now, runs);
    for (size_t i = 0; i < conditions_.size(); ++i) {
        const glm::vec3& pull = conditions_[i].pull;
        conditions[i] = {now - conditions_[i].begin, {pull.x, pull.y, pull.z}, 0.0f};
    }
    auto* at = reinterpret_cast<std::byte*>(group.editColumn64(0).data());
    put(at, std::span<const base::GpuParticleMoment>(&moment, 1));
    put(at, std::span<const base::GpuBirthRun>(runs).first(moment.runs));
    put(at, std::span<const base::GpuCondition>(conditions).first(moment.conditions));
    std::array<base::GpuStepRun, base::kMaxGpuStepRuns> steps;
    stepLog_.publish(now, steps);
    put(at, std::span<const base::GpuStepRun>(steps).first(moment.stepRuns));
    group.setProgram(program_.gpu);
    writeConstants(program_.def, program_.def.appearance, 1.0f, group.editConstants());
    base::GroupInfo& info = group.editInfo();
    info = base;
    info.kind = kind;
    info.count =
        uint32_t((sizeof moment + moment.runs * sizeof runs[0] + moment.conditions * sizeof conditions[0] +
                  moment.stepRuns * sizeof(base::GpuStepRun)) /
                 8);
    if (moment.window > 0)
        info.bounds = bounds(now, snapshot.secondsBack());
}

} // namespace fx::sim
