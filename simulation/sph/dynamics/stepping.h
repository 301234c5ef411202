/// @file stepping.h
/// Kicks, the choice of the next step, and the waking of neighbors.
///
/// @formula kick-drift-kick
/// Every particle is kicked in the middle of its step and drifts between the middles.
///
/// symbol   unit   meaning
///   v, K          velocity and entropy function, at the middle of the step
///   a, K'         their rates, at the beginning of the step
///   b, e   tick   beginning and end of the step
///   t      tick   now
/// @derivation
///   at t = e with rates a of now: v(t) = v + (t - (b + e)/2) a                                    (1)
///   a new step begins: v = v(t) + (e' - t)/2 a                                                    (2)
///   With rates that depend on positions alone (no dissipation) and equal steps this is the leapfrog, which
///   is symplectic. A step that is cut short to e'' before its end keeps its rates:
///       v += ((b + e'')/2 - (b + e)/2) a                                                          (3)
///   The position drifts with v before and after, so it changes at t, not before.
///   A step is at most r times that of any neighbor: a particle takes at most r times the shortest step among
///   those it sees, and wakes each neighbor whose step is more than r times its own                 (4)
///   The step s of the caller has just passed, and in it forces that the sleeper has not felt. Until t - s
///   the sleeper's old rates hold, from there those of now: its step becomes [t - s, t), and by (1)
///       v(t) = v + (t - s/2 - (b + e)/2) a + s/2 a(t)                                              (5)
/// @source    [SPR05] section 4 for (1), (2); [SM09] for the limiter, [DDV12] section 2.2 for (3), (4)
/// @deviation (5) instead of ending the sleeper's step at the next multiple of the shorter step: half of a
/// long
///            step with the rates of a shock that has just arrived would add energy without work, and
///            forces between the caller and a sleeper would not be opposite. Waking reaches direct neighbors;
///            theirs follow when they are active
/// @valid     r a power of two, or infinite: no limiter
/// @accuracy  integer ticks: no particle misses another's step
/// @tests     tests/simulation/dynamics/test_time_steps.cpp
#pragma once

#include "simulation/sph/dynamics/dynamics_state.h"

namespace fx::sim {

/// (1) for the active slots, with their new rates. Positions hold for now afterwards.
template <class T>
void closeSteps(DynamicsState<T>& state, base::TaskRunner& tasks);

/// (2), (4): next steps for the active slots, inside a frame.
template <class T>
void openSteps(DynamicsState<T>& state, base::TaskRunner& tasks);

/// (3) for one particle; `end` lies after now or is now. The rates at its end will hold for half the step.
template <class T>
void shortenStep(DynamicsState<T>& state, uint32_t slot, uint64_t end);

/// (5) for one particle, whose step ends now. The rates of now will hold for half of the last `lately` ticks.
template <class T>
void endStepNow(DynamicsState<T>& state, uint32_t slot, uint64_t lately);

/// Begins a frame of `seconds`: all particles begin a step.
template <class T>
void openFrame(DynamicsState<T>& state, double seconds, base::TaskRunner& tasks);

/// [s] Shortest of all wanted steps.
template <class T>
double shortestStep(DynamicsState<T>& state, base::TaskRunner& tasks);

// (4), in step_limiter.cpp: keeps the steps of neighbors within a factor of each other.

/// Levels of the next steps of the active slots: the largest that their criteria, their neighbors and the
/// clock allow.
template <class T>
void chooseLevels(DynamicsState<T>& state, base::TaskRunner& tasks);

/// Ends the steps of neighbors of the active slots that are too long, now. They become the active slots, to
/// be evaluated at once. @return how many
template <class T>
uint32_t wakeNeighbors(DynamicsState<T>& state, base::TaskRunner& tasks);

/// Limits wanted steps by those of the neighbors, at the end of a frame when all are active and listed.
template <class T>
void limitWantedSteps(DynamicsState<T>& state, base::TaskRunner& tasks);

} // namespace fx::sim
