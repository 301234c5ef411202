/// @file finite_memory_solver.h
/// Interface of solvers whose state depends only on a limited past.
#pragma once

#include "simulation/solver/solver.h"

namespace fx::sim {

/// A solver whose elements all die within a known time. Its state can be discarded if the solver is hidden
/// for longer than this time. See Solver::finiteMemory().
class FiniteMemorySolver
{
public:
    /// [tick] Local time at which all presently living elements are dead, if the host's parameters do not
    /// change; the largest number if unknown.
    virtual base::Ticks influenceHorizon(const InstanceParameters& parameters) const = 0;

    /// Saves the state without living elements, in the format of Solver::save(). A restored state is correct
    /// after influenceHorizon().
    virtual void saveWithoutElements(StateWriter& writer) const = 0;

    /// Advances to local time `tick` without births. The state is correct after the influenceHorizon() of
    /// this time. Requires a known influenceHorizon(). The context's tick and stepTicks are ignored.
    virtual void passOver(const StepContext& context, base::Ticks tick) = 0;

protected:
    ~FiniteMemorySolver() = default;
};

} // namespace fx::sim
