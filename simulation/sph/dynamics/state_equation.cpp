#include "simulation/sph/dynamics/state_equation.h"

#include "foundation/math/elementary.h"

#include <cmath>

namespace fx::sim {

namespace {

struct ColdCurve
{
    double pressure = 0; ///< [Pa]
    double energy = 0;   ///< [J/kg]
    double slope = 0;    ///< [m2/s2]
};

ColdCurve coldCurve(const StateEquation& equation, double rho)
{
    ColdCurve cold;
    if (equation.stiffness > 0) { // (4)
        cold.pressure = -equation.stiffness;
        cold.energy = equation.stiffness / rho;
    }
    if (equation.jwlA > 0 || equation.jwlB > 0) { // (5)
        const double volume = equation.referenceDensity / rho;
        const double a = equation.jwlA * base::naturalExp(-equation.jwlR1 * volume);
        const double b = equation.jwlB * base::naturalExp(-equation.jwlR2 * volume);
        cold.pressure += a + b;
        cold.energy += (a / equation.jwlR1 + b / equation.jwlR2) / equation.referenceDensity;
        cold.slope += (a * equation.jwlR1 + b * equation.jwlR2) * volume / rho;
    }
    return cold;
}

} // namespace

StatePoint stateAt(const StateEquation& equation, double rho, double entropy)
{
    const ColdCurve cold = coldCurve(equation, rho);
    const double rise = base::power(rho, equation.gamma - 1.0); // rho^(g-1)
    const double ideal = entropy * rise;                        // K rho^(g-1) = P / rho of the thermal part
    const double soundSquared = cold.slope + equation.gamma * ideal;
    StatePoint state;
    state.pressure = cold.pressure + rho * ideal; // (1)
    state.thermal = ideal / (equation.gamma - 1.0);
    state.energy = cold.energy + state.thermal;
    state.sound = soundSquared > 0 ? std::sqrt(soundSquared) : 0.0; // (2)
    state.heatToEntropy = (equation.gamma - 1.0) / rise;            // (3)
    return state;
}

double entropyOf(const StateEquation& equation, double rho, double energy)
{
    const double thermal = energy - coldCurve(equation, rho).energy;
    return thermal > 0 ? (equation.gamma - 1.0) * thermal / base::power(rho, equation.gamma - 1.0) : 0.0;
}

} // namespace fx::sim
