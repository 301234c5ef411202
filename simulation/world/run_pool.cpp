#include "simulation/world/run_pool.h"

#include <algorithm>
#include <bit>
#include <stdexcept>
#include <utility>

namespace fx::sim {

namespace {

uint64_t bitsOf(float x, float y)
{
    return std::bit_cast<uint32_t>(x) | (uint64_t(std::bit_cast<uint32_t>(y)) << 32);
}

uint64_t bitsOf(double x)
{
    return std::bit_cast<uint64_t>(x);
}

/// Everything of the conditions as whole words.
std::array<uint64_t, 17> words(const RunConditions& c)
{
    const base::Placement& p = c.placement;
    const uint64_t choices =
        (uint64_t(c.quality.level) << 2) | (uint64_t(c.hasContact) << 1) | uint64_t(c.parameters.emitting);
    return {c.seed,
            uint64_t(c.clock.scene),
            uint64_t(c.clock.local),
            c.clock.rate,
            choices,
            bitsOf(c.gravity.x, c.gravity.y),
            bitsOf(c.gravity.z, c.wind.x),
            bitsOf(c.wind.y, c.wind.z),
            bitsOf(c.groundHeight, c.parameters.intensity),
            c.field ? c.field->hash() : 0,
            bitsOf(p.position.x),
            bitsOf(p.position.y),
            bitsOf(p.position.z),
            bitsOf(p.rotation.x, p.rotation.y),
            bitsOf(p.rotation.z, p.rotation.w),
            bitsOf(p.scale, c.worldWind.x),
            bitsOf(c.worldWind.y, c.worldWind.z)};
}

} // namespace

bool RunConditions::equals(const RunConditions& other) const
{
    return words(*this) == words(other);
}

uint64_t RunConditions::hash() const
{
    uint64_t hash = 0;
    for (const uint64_t word : words(*this))
        hash = base::hashWord(hash, word);
    return hash;
}

void Run::save(StateWriter& writer) const
{
    if (kept)
        kept->copyTo(writer);
    for (const std::unique_ptr<Solver>& solver : solvers)
        solver->save(writer);
}

void Run::saveBriefly(StateWriter& writer) const
{
    for (const std::unique_ptr<Solver>& solver : solvers)
        solver->finiteMemory()->saveBriefly(writer);
}

base::Ticks Run::influenceHorizon() const
{
    if (!changes.empty() || !told.empty() || conditions.clock.rate == 0)
        return kNever;
    base::Ticks longest = 0;
    for (const std::unique_ptr<Solver>& solver : solvers) {
        const FiniteMemorySolver* const finite = solver->finiteMemory();
        longest = std::max(longest, finite ? finite->influenceHorizon(conditions.parameters) : kNever);
    }
    return longest;
}

void Run::restore(StateReader& reader)
{
    for (const std::unique_ptr<Solver>& solver : solvers)
        if (reader.ok())
            solver->restore(reader);
}

RunPool::RunPool(const base::SnapshotSchema* schema, std::pmr::memory_resource* memory, bool share)
    : schema_(schema), memory_(memory), share_(share)
{
    chains_.fill(kNoRun);
    spares_.reserve(kMostSpares); // putting aside must not fail
}

RunIndex RunPool::enter(const std::shared_ptr<const EffectDef>& effect, const RunConditions& conditions,
                        bool released)
{
    RunIndex index = findFresh(effect.get(), conditions);
    if (index == kNoRun) {
        index = create(effect, conditions, released);
        welcome(index);
    } else if (!released) {
        materialize(index);
    }
    ++runs_[index].users;
    return index;
}

RunIndex RunPool::create(const std::shared_ptr<const EffectDef>& effect, const RunConditions& conditions,
                         bool released)
{
    Run run;
    run.effect = effect;
    run.conditions = conditions;
    run.simulated = conditions.clock.scene;
    run.released = released;
    if (!released)
        makeSolvers(run);
    run.fresh = true;
    run.nextFresh = kNoRun;
    if (free_.empty()) {
        free_.reserve(runs_.size() + 1); // leave() must not fail
        runs_.push_back(std::move(run));
        ++count_;
        return RunIndex(runs_.size() - 1);
    }
    const RunIndex index = free_.back();
    free_.pop_back();
    runs_[index] = std::move(run);
    ++count_;
    return index;
}

RunIndex RunPool::copy(RunIndex index)
{
    StateBuffer state(memory_);
    runs_[index].save(state);
    const std::shared_ptr<const EffectDef> effect = runs_[index].effect;
    std::vector<Run::Change> changes = runs_[index].changes;
    std::vector<Run::Told> told = runs_[index].told;
    const RunIndex made = create(effect, runs_[index].conditions, runs_[index].released);
    const Run& from = runs_[index];
    Run& run = runs_[made];
    run.users = 1;
    run.fresh = from.fresh;
    run.simulated = from.simulated;
    run.arriving = from.arriving;
    run.reached = from.reached;
    run.target = from.target;
    run.stepLength = from.stepLength;
    run.changes = std::move(changes);
    run.told = std::move(told);
    run.field = from.field;
    if (run.released) {
        run.pristine = from.pristine;
        run.brief = from.brief;
        run.forgottenAt = from.forgottenAt;
        if (from.kept)
            run.kept.emplace(std::move(state));
        return made;
    }
    StateReader reader(state.bytes());
    run.restore(reader);
    if (reader.ok() && reader.left() == 0)
        return made;
    leave(made);
    throw std::logic_error("a solver does not take its own state: " + reader.status().message());
}

void RunPool::reset(RunIndex index, const RunConditions& conditions)
{
    unlink(index); // the chain is that of the old conditions
    runs_[index].conditions = conditions;
    runs_[index].quietUntil = 0;
    welcome(index);
}

RunIndex RunPool::change(RunIndex index, const RunConditions& conditions)
{
    if (runs_[index].conditions.equals(conditions))
        return index;
    const bool isAlone = runs_[index].users == 1;
    if (runs_[index].fresh && (!isAlone || findFresh(runs_[index].effect.get(), conditions) != kNoRun)) {
        const std::shared_ptr<const EffectDef> effect = runs_[index].effect;
        const RunIndex other = enter(effect, conditions, runs_[index].released); // there is no past to copy
        leave(index);
        return other;
    }
    if (isAlone) {
        reset(index, conditions);
        return index;
    }
    const RunIndex own = copy(index);
    runs_[own].conditions = conditions;
    leave(index);
    return own;
}

void RunPool::leave(RunIndex index)
{
    Run& run = runs_[index];
    if (run.users > 1) {
        --run.users;
        return;
    }
    unlink(index);
    run = Run{};
    free_.push_back(index);
    --count_;
}

void RunPool::touch(RunIndex index)
{
    unlink(index);
    runs_[index].fresh = false;
    runs_[index].quietUntil = 0; // of the conditions and the state before
}

void RunPool::welcome(RunIndex index)
{
    Run& run = runs_[index];
    if (!share_ || !run.fresh)
        return;
    uint32_t& first = chainOf(run);
    run.nextFresh = first;
    first = index;
}

RunIndex RunPool::findFresh(const EffectDef* effect, const RunConditions& conditions) const
{
    RunIndex index = chains_[conditions.hash() % kChains];
    while (index != kNoRun &&
           !(runs_[index].effect.get() == effect && runs_[index].conditions.equals(conditions)))
        index = runs_[index].nextFresh;
    return index;
}

/// Takes a run out of its chain, if it is in one.
void RunPool::unlink(RunIndex index)
{
    if (!runs_[index].fresh)
        return;
    uint32_t* at = &chainOf(runs_[index]);
    while (*at != kNoRun && *at != index)
        at = &runs_[*at].nextFresh;
    if (*at == index)
        *at = runs_[index].nextFresh;
    runs_[index].nextFresh = kNoRun;
}

void RunPool::swap(RunPool& other) noexcept
{
    std::swap(runs_, other.runs_);
    std::swap(free_, other.free_);
    std::swap(chains_, other.chains_);
    std::swap(count_, other.count_);
}

} // namespace fx::sim
