#include "simulation/emitters/gpu_emitter.h"

#include "foundation/random/philox.h"
#include "foundation/snapshot/gpu_particles.h"
#include "simulation/emitters/look_constants.h"

#include <glm/common.hpp>

#include <algorithm>
#include <array>
#include <cstring>

namespace fx::sim {

namespace {

constexpr base::Ticks kRounding = 16; ///< [tick] more than ages are rounded by, besides their 2^-20

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
    : program_(program), rows_(program.gpu->rows),
      window_(program.longestLife + program.longestLife / (1 << 20) + kRounding), log_(memory),
      conditions_(memory)
{
    conditions_.reserve(base::kMostGpuConditions);
    conditions_.push_back({0, glm::vec3(0.0f)});
}

void GpuEmitter::clear(base::Ticks now, uint64_t next, const glm::vec3& pull)
{
    log_.clear(next);
    conditions_.assign(1, {now, pull});
    known_ = now;
    dropped_ = -1;
    on_ = false;
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
    size_t gone = 0;
    while (gone + 1 < conditions_.size() && conditions_[gone + 1].begin <= oldest)
        ++gone;
    conditions_.erase(conditions_.begin(), conditions_.begin() + std::ptrdiff_t(gone));
}

bool GpuEmitter::mayGoOn() const
{
    return surelyFits() && log_.runs() <= base::kMostGpuRuns &&
           conditions_.size() <= base::kMostGpuConditions;
}

bool GpuEmitter::mayBegin(base::Ticks now) const
{
    const base::Ticks oldest = now - window_;
    const bool isKnown = (known_ == 0 || known_ < oldest) && dropped_ < std::max<base::Ticks>(oldest, 0);
    // With some room, so that it does not come and go with every step.
    return isKnown && surelyFits() && 4 * log_.runs() <= 3 * base::kMostGpuRuns &&
           4 * conditions_.size() <= 3 * base::kMostGpuConditions;
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

LookJob GpuEmitter::rebuild(const BirthKey& key, base::Ticks now, ParticleStore& store) const
{
    return replayBirths(program_,
                        {key, log_.front(), log_.next(),
                         [this](uint64_t first, std::span<base::Ticks> out) { log_.ticksOf(first, out); },
                         conditions_, now, store.placed},
                        store);
}

base::Bounds GpuEmitter::bounds() const
{
    glm::vec3 low = conditions_[0].pull, high = low;
    for (const MotionCondition& condition : conditions_) {
        low = glm::min(low, condition.pull);
        high = glm::max(high, condition.pull);
    }
    return boundsOfAll(program_.def, low, high, float(base::toSeconds(program_.longestLife)));
}

void GpuEmitter::publish(const base::GroupInfo& base, base::KindId kind, const BirthKey& key, base::Ticks now,
                         base::FrameSnapshot& snapshot) const
{
    base::SnapshotGroup& group = snapshot.addGroup(kind, base::kMostGpuWords);
    std::array<base::GpuBirthRun, base::kMostGpuRuns> runs;
    std::array<base::GpuCondition, base::kMostGpuConditions> conditions;
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
    log_.publish(now, runs);
    for (size_t i = 0; i < conditions_.size(); ++i) {
        const glm::vec3& pull = conditions_[i].pull;
        conditions[i] = {now - conditions_[i].begin, {pull.x, pull.y, pull.z}, 0.0f};
    }
    auto* at = reinterpret_cast<std::byte*>(group.editColumn64(0).data());
    put(at, std::span<const base::GpuParticleMoment>(&moment, 1));
    put(at, std::span<const base::GpuBirthRun>(runs).first(moment.runs));
    put(at, std::span<const base::GpuCondition>(conditions).first(moment.conditions));
    group.setProgram(program_.gpu);
    writeConstants(program_.def, program_.def.look, 1.0f, group.editConstants());
    base::GroupInfo& info = group.editInfo();
    info = base;
    info.kind = kind;
    info.count = uint32_t(
        (sizeof moment + moment.runs * sizeof runs[0] + moment.conditions * sizeof conditions[0]) / 8);
    if (moment.window > 0)
        info.bounds = bounds();
}

} // namespace fx::sim
