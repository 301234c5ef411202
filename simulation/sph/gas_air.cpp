#include "simulation/sph/gas_air.h"

#include "foundation/math/elementary.h"
#include "foundation/random/philox.h"
#include "simulation/emitters/emitter_def.h"

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

glm::vec3 GasAir::velocity(const glm::vec3& position, float temperature) const
{
    glm::vec3 air = wind_;
    if (thermal_.active())
        air += def_.rolling * thermal_.circulation(position);
    if (!noise_.active())
        return air;
    const float excess = (temperature - kAirTemperature) / (kFlameTemperature - kAirTemperature);
    const float fade = 0.3f + 0.7f * std::sqrt(std::clamp(excess, 0.0f, 1.0f));
    return air + fade * noise_.velocity(position);
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
