// What a gas is expected to need.
#include "simulation/gas/gas_solver.h"

#include <algorithm>
#include <cmath>

namespace fx::sim {

namespace {
constexpr double kActiveShare = 0.5; ///< [1] of the particles whose rates a sub-step evaluates
}

uint64_t GasDef::bytes() const
{
    return kGasBytes * uint64_t(particles) + (detail.given ? MaterialCoordinates::bytesOf(particles) : 0);
}

/// The first step is the most expensive: the charge is as small and as hot as it will ever be.
double GasDef::workOf(const StepLoad& load) const
{
    const Quality quality;
    const ChargePlan plan = planCharge(*material, energy, double(pressureRatio));
    if (!(plan.mass > 0.0))
        return 0.0;
    const double count = double(particles);
    const double sound = std::sqrt(plan.gamma * kAirGasConstant * plan.temperature);
    const double limit = soundSpeed > 0.0f ? std::min(double(soundSpeed), sound) : sound;
    // Root mean square: of a ball that is thrown, or that has turned half of what drives it into motion.
    const double thrown = 0.77 * double(throwSpeed) * plan.rimSpeed;
    const double driven =
        plan.pressure > AmbientAir{}.pressure ? limit / std::sqrt(plan.gamma * (plan.gamma - 1.0)) : 0.0;
    const double flow = std::max(thrown, driven);
    const double reduced =
        std::clamp(std::min(limit, std::max(flow / double(quality.flowMach), 1.0)), 1e-3 * sound, sound);
    const double slices =
        std::clamp(std::ceil(load.seconds * 3.0 * (flow + reduced) / plan.radius), 1.0, kMaxGasSlices);
    const double support = evenSupport(plan.radius, particles, double(quality.neighbors));
    const double longest = kGasCourant * support / (2.0 * reduced + flow);
    const double subSteps = std::clamp(load.seconds / longest, slices, slices * double(kMaxGasSubSteps));
    const double pairs =
        count * double(quality.neighbors) * double(gas_work::kPair) / double(gas_work::kParts);
    const double one =
        count * (double(gas_work::kParticle) / double(gas_work::kParts) + double(gas_work::kEvaluation));
    return count * (slices * double(kGasExchangeWork) + double(kGasShownWork)) +
           kActiveShare * subSteps * (one + pairs);
}

} // namespace fx::sim
