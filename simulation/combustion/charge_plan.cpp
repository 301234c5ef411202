#include "simulation/combustion/charge_plan.h"

#include "foundation/math/elementary.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace fx::sim {

namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kGammaOfAir = 1.4;

double durationOf(const Material& material, double mass, double root)
{
    if (material.largeMass > 0.0 && mass > material.largeMass)
        return material.largeDuration * std::sqrt(root); // (5)
    return material.fireballDuration * root;
}

} // namespace

ChargePlan planCharge(const Material& material, double energy, double pressureRatio, const AmbientAir& air)
{
    ChargePlan plan;
    if (!(energy > 0.0) || !(energy < std::numeric_limits<double>::infinity()))
        return plan;
    const bool hasHeat = material.heatAtStart > 0.0;
    const double ratio = hasHeat && pressureRatio > 1.0 ? std::min(pressureRatio, 1e4) : 1.0;
    const double specific = material.gasConstant * material.startTemperature;
    plan.mass = energy / material.nominalEnergy; // (1)
    plan.temperature = material.startTemperature;
    plan.pressure = air.pressure * ratio;
    plan.density = plan.pressure / specific; // (2)
    plan.radius = base::cubeRoot(plan.mass / plan.density * (3.0 / (4.0 * kPi)));
    plan.gamma = hasHeat ? 1.0 + specific / material.heatAtStart : kGammaOfAir; // (3) (4)
    plan.rimSpeed = material.startSpeed;
    plan.heat = plan.mass * material.heatAtStart;
    plan.fuel = plan.mass * material.heatOfCombustion;
    const double root = base::cubeRoot(plan.mass);
    plan.fireballDiameter = material.fireballDiameter * root; // (5)
    plan.fireballDuration = durationOf(material, plan.mass, root);
    return plan;
}

} // namespace fx::sim
