/// @file frame.h
/// A frame from its beginning to its end.
#pragma once

#include "simulation/sph/dynamics/dynamics_state.h"

namespace fx::sim {

/// Gives new particles supports, densities and entropies, then evaluates everybody if anything has changed
/// from outside. Nothing to do otherwise.
template <class T>
void prepare(DynamicsState<T>& state, base::TaskRunner& tasks);

/// Steps by `seconds` > 0 within the budget of sub-steps. Where `work` is spent before, state.advance stays
/// open, and the next call goes on; the report is that of all calls.
template <class T>
AdvanceReport runFrames(DynamicsState<T>& state, double seconds, base::TaskRunner& tasks,
                        base::WorkBudget& work);

} // namespace fx::sim
