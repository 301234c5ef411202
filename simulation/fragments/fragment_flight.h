/// @file fragment_flight.h
/// Flight and cooling of one fragment.
///
/// @formula quadratic-drag-step
/// A step of a body with drag proportional to the square of its speed.
///
/// symbol   unit   meaning
///   rho_a, rho  kg/m3  density of the air, of the body
///   C_d     1      drag coefficient
///   d       m      diameter
///   b       1/m    drag per distance through the air
///   w       m/s    speed relative to the air, before (0) and after (1)
///   k       1/s    equivalent rate of linear drag during the step
/// @derivation
///   m dv/dt = -C_d rho_a (pi d^2 / 4) |w| w / 2 with m = rho pi d^3 / 6 gives
///       dw/dt = -b |w| w,  b = (3/4) C_d rho_a / (rho d)                            (1)
///   A linear-drag-step with k = b w_0 predicts w_1                                  (2)
///   and one with the mean rate k = b (w_0 + w_1) / 2 is the result                  (3)
/// @source    elementary; the linear step is formula linear-drag-step
/// @deviation drag coefficient independent of the Reynolds number
/// @valid     any step length: the linear step never overshoots the air's velocity
/// @accuracy  second order in the step; free flight (b = 0) and flight at the terminal velocity
///            (g / b)^(1/2) exact to rounding
/// @tests     tests/simulation/fragments/test_fragment_flight.cpp
///
/// @formula fragment-cooling
/// Temperature of a hot body after a step, radiation and convection each solved exactly.
///
/// symbol   unit      meaning
///   T, T_a  K         temperature of the body, of the air
///   e       1         emissivity
///   c       J/(kg K)  specific heat
///   t       s         length of the step
///   Re, Nu, Pr  1     Reynolds, Nusselt, Prandtl number of the film of air
///   L, nu   W/(m K), m2/s  conductivity and viscosity of that film, at 700 K
/// @derivation
///   Surface over heat capacity of a ball: 6 / (rho c d)
///   convection at the rate q = 6 Nu L / (rho c d^2), Nu = 2 + 0.6 Re^(1/2) Pr^(1/3), Re = w d / nu   (4)
///       T <- T_a + (T - T_a) exp(-q t)                                                              (5)
///   radiation dT/dt = -r T^4 with r = 6 e sigma / (rho c d):
///       T <- T (1 + 3 r t T^3)^(-1/3), not below T_a                                                (6)
///   half of the radiation before the convection, half of it afterwards (Strang splitting)          (7)
/// @source    [RM52] for Nu; the rest is elementary
/// @deviation one temperature for the whole body; radiation of the air is replaced by the lower bound T_a
/// @valid     T >= T_a; any step length
/// @accuracy  each part exact to rounding; both together second order in the step
/// @tests     tests/simulation/fragments/test_fragment_flight.cpp
#pragma once

#include "simulation/fragments/fragments_def.h"
#include "simulation/motion/ground_contact.h"

namespace fx::sim {

constexpr float kAirDensity = 1.204f; ///< [kg/m3] density of air at 20 degrees C

/// [1/m] Drag coefficient b of equation (1).
float dragPerMeter(const FragmentMatter& matter, float size);

/// A step of flight without ground contact.
/// @param air [m/s] velocity of the air
/// @param perMeter [1/m] drag coefficient b
MotionState flyStep(const MotionState& from, const glm::vec3& acceleration, const glm::vec3& air,
                    float perMeter, float seconds);

struct CoolingRates
{
    double convection; ///< [1/s] convection rate q
    double radiation;  ///< [1/(s K3)] radiation rate r
};

/// Both rates of a fragment of diameter `size` [m] that moves at `speed` [m/s] relative to the air.
CoolingRates coolingRates(const FragmentMatter& matter, float size, float speed);

/// Temperature [K] after a step.
float coolStep(float temperature, const CoolingRates& rates, float seconds);

} // namespace fx::sim
