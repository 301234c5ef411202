#include "simulation/gas/gas_air.h"

#include "foundation/math/elementary.h"
#include "foundation/random/philox.h"
#include "simulation/motion/ambient_air.h"

#include <algorithm>
#include <cmath>

namespace fx::sim {

namespace {

constexpr float kFlameTemperature = 2000.0f; ///< [K] at which turbulence has its full strength

CurlNoise makeNoise(const GasDef& def, const StepContext& step)
{
    const base::Random4 words =
        base::philox({0, 0, step.solverIndex, uint32_t(base::RandomPurpose::Noise)}, step.seed);
    const double turnover = double(def.curlStrength) / std::max(double(def.curlScale), 1e-3); // [1/s]
    return {words[0], def.curlStrength, def.curlScale, 0.25 * turnover * base::toSeconds(step.tick)};
}

} // namespace

GasAir::GasAir(const GasDef& def, const StepContext& step, const ThermalFlow& thermal)
    : def_(def), wind_(step.wind), noise_(makeNoise(def, step)), thermal_(thermal)
{}

void GasAir::Turbulence::evaluate(const GasAir& air, const GasView<float>& gas, uint32_t first,
                                  uint32_t count)
{
    if (!air.noise_.active())
        return;
    const float* const from[3] = {gas.x, gas.y, gas.z};
    for (uint32_t a = 0; a < 3; ++a) {
        std::copy_n(from[a] + first, count, position_[a]);
        std::fill_n(velocity_[a], kMax, -0.0f); // to which a sum adds nothing, not even a sign
    }
    air.noise_.addTo({position_[0], position_[1], position_[2]}, {velocity_[0], velocity_[1], velocity_[2]},
                     count);
}

glm::vec3 GasAir::velocity(const glm::vec3& position, float temperature, const glm::vec3& turbulence) const
{
    glm::vec3 air = wind_;
    if (thermal_.active())
        air += def_.rolling * thermal_.circulation(position);
    if (!noise_.active())
        return air;
    const float excess = (temperature - kAirTemperature) / (kFlameTemperature - kAirTemperature);
    const float fade = 0.3f + 0.7f * std::sqrt(std::clamp(excess, 0.0f, 1.0f));
    return air + fade * turbulence;
}

double GasThermodynamics::densityRatio(const FireParcel& parcel) const
{
    const double density = air.pressure / (gasConstant(parcel.mixing) * parcel.temperature); // (2)
    return density / airDensity();
}

double GasThermodynamics::entropy(const FireParcel& parcel) const
{
    return air.pressure *
           base::power(gasConstant(parcel.mixing) * parcel.temperature / air.pressure, gamma); // (3)
}

double GasThermodynamics::potentialTemperature(double entropy, double mixing) const
{
    return base::power(entropy / air.pressure, 1.0 / gamma) * air.pressure / gasConstant(mixing); // (4)
}

} // namespace fx::sim
