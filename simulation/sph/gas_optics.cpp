#include "simulation/sph/gas_optics.h"

#include "foundation/math/elementary.h"
#include "simulation/emitters/emitter_def.h"

#include <algorithm>

namespace fx::sim {

namespace {

namespace column = gas_column;

constexpr float kMostMixed = 1e6f;  ///< [1] limit of M
constexpr float kFireWidth = 0.2f;  ///< [1] half width of the change from fire to smoke, of its temperature
constexpr float kSootWindow = 1.6f; ///< [1] temperature at which soot begins to form, over that of its end

} // namespace

Parcel coolParcel(const Parcel& parcel, float mixingRate, float radiationRate, float initial, float seconds)
{
    const double exponent = double(mixingRate) * double(seconds);
    const float left = float(base::naturalExp(-exponent));
    const float mixed = kAirTemperature + (parcel.temperature - kAirTemperature) * left; // (1)
    const float mixing = parcel.mixing * float(base::naturalExp(std::min(exponent, 40.0)));

    const double ratio = double(mixed) / double(initial);
    const double growth = 1.0 + 3.0 * double(radiationRate) * double(seconds) * ratio * ratio * ratio;
    const float radiated = float(double(mixed) / base::cubeRoot(growth)); // (2)
    return {std::clamp(radiated, std::min(kAirTemperature, parcel.temperature), parcel.temperature),
            std::min(mixing, kMostMixed)};
}

void coolGas(const GasDef& def, GasStore& gas, float seconds, uint32_t begin, uint32_t end)
{
    for (uint32_t i = begin; i < end; ++i) {
        const float pace = gas.at(column::Vigor)[i] * (0.4f + 1.2f * gas.at(column::Exposure)[i]); // (3)
        const Parcel parcel = coolParcel({gas.at(column::Temperature)[i], gas.at(column::Mixing)[i]},
                                         def.cooling * pace, def.radiation * pace, def.temperature, seconds);
        gas.at(column::Temperature)[i] = parcel.temperature;
        gas.at(column::Mixing)[i] = parcel.mixing;

        const float burnt =
            base::smoothStep(def.sootTemperature, kSootWindow * def.sootTemperature, parcel.temperature);
        float& soot = gas.at(column::Soot)[i];
        soot = std::max(soot, 1.0f - burnt); // (4)
        gas.at(column::Presence)[i] *=
            float(base::naturalExp(-double(def.dissipation) * double(soot) * double(seconds))); // (5)
    }
}

float fireShareOf(const GasDef& def, float temperature)
{
    return base::smoothStep((1.0f - kFireWidth) * def.sootTemperature,
                            (1.0f + kFireWidth) * def.sootTemperature, temperature);
}

} // namespace fx::sim
