// How long what is alive influences an emitter, and states without it.
#include "simulation/emitters/emitter_solver.h"

#include <limits>

namespace fx::sim {

/// [tick] after which nothing is left of a particle. Births that find their row taken are dropped; where
/// there may have been such births under other conditions, those that they made room for have to be gone too.
base::Ticks EmitterSolver::lifetimeOf(double intensity) const
{
    const bool isSteady = !varied_ && (!started_ || intensity == double(conditions_.intensity));
    return (isSteady ? 1 : 2) * program_.longestLife + base::kTicksPerSecond;
}

base::Ticks EmitterSolver::influenceHorizon(const InstanceParameters& parameters) const
{
    const bool isAlone = !isLinked() && !trails_ && !space_ && !interest_.in(EventKind::Host);
    const bool hasRows = !(gpu_ && gpu_->isOn());
    const auto intensity = double(parameters.intensity);
    return isAlone && hasRows && neverDrops(intensity) ? lifetimeOf(intensity)
                                                       : std::numeric_limits<base::Ticks>::max();
}

void EmitterSolver::passOver(const StepContext& context, base::Ticks tick)
{
    tasks_ = context.tasks;
    schedule_.passTo(now_);
    key_ = {context.seed, context.solverIndex};
    if (!started_)
        begin(context);
    schedule_.setSeed(context.seed, context.solverIndex);
    applyConditions(context);
    const BirthWindow past{now_, tick, double(context.parameters->intensity), context.parameters->emitting};
    store_.clear(store_.next() + schedule_.advance(past, {}).total);
    now_ = tick;
    if (detail_)
        detail_->begin(store_.next(), now_);
    listenAgain();
}

} // namespace fx::sim
