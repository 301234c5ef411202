/// @file stepping.h
/// Kicks, the choice of the next step, and the early end of longer steps of neighbors.
///
/// @formula kick-drift-kick
/// The velocity changes at the middles of steps; the position drifts with it between the middles.
///
/// symbol   unit   meaning
///   v, K          velocity and entropy function, at the middle of the step
///   a, K'         their rates, at the beginning of the step
///   b, e   tick   beginning and end of the step
///   t      tick   present time
/// @derivation
///   at t = e with the present rates a: v(t) = v + (t - (b + e)/2) a                               (1)
///   a new step begins: v = v(t) + (e' - t)/2 a                                                    (2)
///   With rates that depend on positions alone (no dissipation) and equal steps this is the leapfrog, which
///   is symplectic. A step that is cut short to e'' before its end keeps its rates:
///       v += ((b + e'')/2 - (b + e)/2) a                                                          (3)
///   The position drifts with v before and after, so it changes at t, not before.
///   A step is at most r times that of any neighbor. A particle takes at most r times the shortest step among
///   its neighbors, and it wakes each neighbor whose step is more than r times its own                (4)
///   When a particle wakes a neighbor, the waking particle has just taken a step s, in which the neighbor has
///   not felt its force. Until t - s the old rates of the neighbor are used, afterwards the present rates:
///   the step of the neighbor becomes [t - s, t), and by (1)
///       v(t) = v + (t - s/2 - (b + e)/2) a + s/2 a(t)                                              (5)
/// @source    [SPR05] section 4 for (1), (2); [SM09] for the limiter, [DDV12] section 2.2 for (3), (4)
/// @deviation (5) is used instead of ending the woken neighbor's step at the next multiple of the shorter
///            step. Otherwise half of a long step with the rates of a shock that has just arrived would add
///            energy without work, and the forces of the pair would not be opposite. Waking reaches direct
///            neighbors; their neighbors are woken when they are active
/// @valid     r a power of two, or infinite: no limiter
/// @accuracy  times are integer ticks, so the ends of steps coincide exactly
/// @tests     tests/simulation/dynamics/test_time_steps.cpp
#pragma once

#include "simulation/sph/dynamics/dynamics_state.h"

namespace fx::sim {

/// Ends the steps of the active slots with their new rates, by equation (1). The velocities of the active
/// slots are then valid at the present time.
template <class T>
void closeSteps(DynamicsState<T>& state, base::TaskRunner& tasks);

/// Begins the next steps of the active slots within a frame, by equations (2) and (4).
template <class T>
void openSteps(DynamicsState<T>& state, base::TaskRunner& tasks);

/// Shortens the step of one particle by equation (3), so that it ends at `end`. `end` must not be before the
/// present time. The acceleration acts for half of the change of the length.
template <class T>
void shortenStep(DynamicsState<T>& state, uint32_t slot, uint64_t end);

/// Ends the step of one particle now, by equation (5). The present rates act for half of the last `lately`
/// ticks.
template <class T>
void endStepNow(DynamicsState<T>& state, uint32_t slot, uint64_t lately);

/// Begins a frame of `seconds`: all particles begin a step.
template <class T>
void openFrame(DynamicsState<T>& state, double seconds, base::TaskRunner& tasks);

/// [s] Smallest step of all particles by the criteria.
template <class T>
double shortestStep(DynamicsState<T>& state, base::TaskRunner& tasks);

// Equation (4), in step_limiter.cpp: limits the ratio of the steps of neighbors.

/// Chooses the levels of the next steps of the active slots. The level is the largest that the criteria, the
/// neighbors and the clock allow.
template <class T>
void chooseLevels(DynamicsState<T>& state, base::TaskRunner& tasks);

/// Ends the steps of neighbors of the active slots now, if the steps are too long by equation (4). These
/// neighbors become the active slots, and must be evaluated at once. @return number of neighbors whose steps
/// were ended
template <class T>
uint32_t wakeNeighbors(DynamicsState<T>& state, base::TaskRunner& tasks);

/// Limits the steps of particles by the steps of their neighbors. Must be called at the end of a frame, when
/// all particles are active and have lists.
template <class T>
void limitWantedSteps(DynamicsState<T>& state, base::TaskRunner& tasks);

} // namespace fx::sim
