/// @file finite_memory_solver.h
/// States that depend on a limited past only.
#pragma once

#include "simulation/solver/solver.h"

namespace fx::sim {

/// A solver whose elements all die within a known time, so that its state need not be kept while it is out of
/// sight for longer. See Solver::finiteMemory().
class FiniteMemorySolver
{
public:
    /// [tick] local time after which no element alive now is left, if the host's parameters do not change;
    /// the largest number if unknown.
    virtual base::Ticks influenceHorizon(const InstanceParameters& parameters) const = 0;

    /// Solver::save() without living elements. A state restored from it is correct after influenceHorizon().
    virtual void saveWithoutElements(StateWriter& writer) const = 0;

    /// Goes forwards to local time `tick` without the births meanwhile: right once influenceHorizon()
    /// has passed after it. Only where that is known; the context's own tick and stepTicks are ignored.
    virtual void passOver(const StepContext& context, base::Ticks tick) = 0;

protected:
    ~FiniteMemorySolver() = default;
};

} // namespace fx::sim
