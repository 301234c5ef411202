// The free list: solvers of removed and released runs, reused by the next run of the same effect.
#include "simulation/world/run_pool.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace fx::sim {

/// Gives `run` solvers in the state before their first step.
void RunPool::makeSolvers(Run& run)
{
    const auto fits = [&](const Spare& spare) {
        return spare.effect == run.effect && spare.level == run.conditions.quality.level;
    };
    const auto found = std::find_if(spares_.begin(), spares_.end(), fits);
    if (found != spares_.end()) {
        run.solvers = std::move(found->solvers);
        run.pristine = std::move(found->pristine);
        spares_.erase(found);
        StateReader reader(run.pristine->bytes());
        run.restore(reader);
        if (!reader.ok() || reader.left() != 0)
            throw std::logic_error("a solver does not take its first state: " + reader.status().message());
        run.meetSolvers();
        return;
    }
    std::vector<std::unique_ptr<Solver>> solvers;
    solvers.reserve(run.effect->solvers.size());
    for (const std::unique_ptr<const SolverDef>& def : run.effect->solvers)
        solvers.push_back(def->create(*schema_, run.conditions.quality, memory_));
    auto pristine =
        std::allocate_shared<StateBuffer>(std::pmr::polymorphic_allocator<StateBuffer>(memory_), memory_);
    for (const std::unique_ptr<Solver>& solver : solvers)
        solver->save(*pristine);
    run.solvers = std::move(solvers);
    run.meetSolvers();
    run.pristine = std::move(pristine);
}

void RunPool::materialize(RunIndex index)
{
    Run& run = runs_[index];
    if (!run.released)
        return;
    Run made;
    made.effect = run.effect;
    made.conditions.quality = run.conditions.quality;
    makeSolvers(made); // may throw; afterwards only a solver that refuses its own state does
    if (run.kept) {
        StateReader reader(run.kept->bytes());
        made.restore(reader);
        if (!reader.ok() || reader.left() != 0)
            throw std::logic_error("a solver does not take its own state: " + reader.status().message());
    }
    run.solvers = std::move(made.solvers);
    run.meetSolvers();
    run.pristine = std::move(made.pristine);
    run.kept.reset();
    run.released = run.brief = false;
}

void RunPool::release(RunIndex index, base::Ticks now, bool mayForget)
{
    const bool isReleased = runs_[index].released;
    mayForget = mayForget && runs_[index].changes.empty();
    if (isReleased && (!mayForget || runs_[index].brief || runs_[index].forgottenAt > now))
        return;
    if (isReleased)
        materialize(index);
    Run& run = runs_[index];
    if (!isReleased) {
        const RunClock& clock = run.conditions.clock;
        const base::Ticks horizon = run.influenceHorizon();
        run.forgottenAt =
            horizon == Run::kNever ? horizon : clock.toScene(clock.toLocal(run.simulated) + horizon);
    }
    const bool brief = mayForget && run.forgottenAt <= now;
    if (!run.fresh) {
        StateBuffer state(memory_);
        brief ? run.saveBriefly(state) : run.save(state);
        state.shrink();
        run.kept.emplace(std::move(state));
    }
    putAside(run, now);
    run.released = true;
    run.brief = brief;
}

/// Never fails. The oldest make room.
void RunPool::putAside(Run& run, base::Ticks now)
{
    if (run.solvers.empty())
        return;
    if (spares_.size() == kMostSpares)
        spares_.erase(spares_.begin());
    spares_.push_back(
        {run.effect, run.conditions.quality.level, std::move(run.solvers), std::move(run.pristine), now});
    run.solvers.clear();
    run.meetSolvers();
}

void RunPool::trimSpares(base::Ticks tick)
{
    const auto isOld = [tick](const Spare& spare) { return spare.since < tick; };
    spares_.erase(spares_.begin(), std::find_if_not(spares_.begin(), spares_.end(), isOld));
}

void RunPool::retire(RunIndex index, base::Ticks now)
{
    if (Run& run = runs_[index]; run.users == 1 && !run.released)
        putAside(run, now);
    leave(index);
}

} // namespace fx::sim
