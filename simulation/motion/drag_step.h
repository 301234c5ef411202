/// @file drag_step.h
/// One step of motion through air with drag, exact for any step length and drag rate.
///
/// @formula linear-drag-step
/// Velocity and position after a step under constant acceleration and drag towards moving air.
///
/// symbol   unit   meaning
///   k       1/s    drag rate, >= 0
///   t       s      length of the step, >= 0
///   a       m/s2   acceleration, constant over the step
///   u       m/s    velocity of the air, constant over the step
///   v, x           velocity and position
///   E       1      decay of the velocity relative to the air
///   G       s      gain: effect of acceleration on velocity
///   R       s2     ramp: effect of acceleration on position
///
/// @derivation
///   dv/dt = a - k (v - u) has the solution, with z = k t,
///       E = exp(-z),  G = (1 - E) / k,  R = (t - G) / k                                   (1)
///       v(t) = E v + (1 - E) u + G a                                                       (2)
///       x(t) = x + G v + (t - G) u + R a                                                   (3)
///   For z < 0.05 the quotients cancel, so their series in z are used:
///       G = t (1 - z/2 + z^2/6 - z^3/24),  R = t^2 (1/2 - z/6 + z^2/24 - z^3/120)          (4)
/// @source    elementary (linear ordinary differential equation)
/// @deviation none
/// @valid     k = 0 is free flight exactly; k <= 1e6 /s (larger is taken as that)
/// @accuracy  coefficients: relative error <= 3e-7 (float rounding of doubles)
/// @tests     tests/simulation/test_drag_step.cpp
#pragma once

#include "foundation/math/elementary.h"

#include <algorithm>

namespace fx::sim {

struct DragStep
{
    float decay;   ///< [1] decay E
    float share;   ///< [1] 1 - E, weight of the air's velocity in the velocity of the particle
    float gain;    ///< [s] gain G
    float drift;   ///< [s] drift t - G
    float ramp;    ///< [s2] ramp R
    float seconds; ///< [s] length t of the step
};

inline DragStep makeDragStep(double rate, double seconds)
{
    const double k = rate > 0.0 ? std::min(rate, 1e6) : 0.0;
    const double z = k * seconds;
    const double decay = base::naturalExp(-z);
    double gain = 0;
    double ramp = 0;
    if (z < 0.05) {
        gain = seconds * (1.0 - z * (0.5 - z * (1.0 / 6.0 - z / 24.0))); // (4)
        ramp = seconds * seconds * (0.5 - z * (1.0 / 6.0 - z * (1.0 / 24.0 - z / 120.0)));
    } else {
        gain = (1.0 - decay) / k; // (1)
        ramp = (seconds - gain) / k;
    }
    return {float(decay), float(k * gain), float(gain), float(seconds - gain), float(ramp), float(seconds)};
}

} // namespace fx::sim
