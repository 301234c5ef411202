#include "simulation/gas/gas_exchange.h"

#include "foundation/math/elementary.h"
#include "simulation/motion/drag_step.h"

#include <glm/geometric.hpp>

#include <algorithm>

namespace fx::sim {

namespace {

constexpr float kInnerDrag = 0.2f;        ///< [1] drag inside the body over drag at its surface
constexpr float kOuterLayer = 0.6f;       ///< [1] exposure of the outermost particles of even gas
constexpr double kMaxLogMassGrowth = 0.5; ///< [1] logarithm of the growth of a parcel's mass in a step
constexpr double kBallVolume = 4.18879020478639;

/// (2) and the entropy that follows.
FireParcel burn(const GasExchange& exchange, const FireParcel& parcel, double mass, double entrainment,
                double exposure, double seconds)
{
    const GasThermodynamics& thermo = exchange.thermodynamics;
    const double density = thermo.densityRatio(parcel) * thermo.airDensity();
    FireSurroundings around;
    around.airTemperature = thermo.air.temperature;
    around.hottest = double(exchange.hottest);
    around.entrainment = entrainment;
    around.radius = base::cubeRoot(mass / density / kBallVolume);
    around.exposure = double(exchange.def.radiation) * exposure;
    FireLedger ledger;
    return burnParcel(*exchange.def.material, parcel, around, seconds, ledger);
}

/// (1)
double entrainmentOf(const GasExchange& exchange, const FireParcel& parcel, float vigor,
                     float surfaceExposure, float speed, double density, double seconds)
{
    const GasThermodynamics& thermo = exchange.thermodynamics;
    const double tau = thermo.densityRatio(parcel);
    const double room = std::min(tau * thermo.airDensity() / density, 1.0);
    const double alight = 1.0 - parcel.burnt;
    const double stirring = 1.0 + (double(exchange.def.entrainment) - 1.0) * alight;
    const double pace = stirring * double(vigor * (0.7f + 0.6f * surfaceExposure)) * room * room;
    const double rate = pace * entrainmentRate(double(speed), double(exchange.air.thermal().radius), tau);
    return std::min(rate, kMaxLogMassGrowth / seconds);
}

glm::vec3 buoyancyOf(const GasExchange& exchange, float tau)
{
    return exchange.step.gravity * (-exchange.def.buoyancy * (1.0f - tau) / (tau + 0.5f)); // (4)
}

/// The particle at the place `i`.
void exchangeOne(const GasExchange& exchange, const GasView<float>& gas, GasParcels& parcels, float seconds,
                 uint32_t i, const glm::vec3& turbulence)
{
    const GasThermodynamics& thermo = exchange.thermodynamics;
    const uint32_t id = gas.id[i];
    FireParcel& parcel = parcels.fire[id];
    const float exposure = gas.exposure[i];
    const float surfaceExposure = std::min(exposure / kOuterLayer, 1.0f); // (0)
    const glm::vec3 position(gas.x[i], gas.y[i], gas.z[i]);
    glm::vec3 velocity(gas.vx[i], gas.vy[i], gas.vz[i]);
    const glm::vec3 air = exchange.air.velocity(position, float(parcel.temperature), turbulence);
    const float speed = glm::length(velocity - air);

    const double entrainment = entrainmentOf(exchange, parcel, parcels.vigor[id], surfaceExposure, speed,
                                             double(gas.density[i]), double(seconds));
    const double before = parcel.mixing;
    parcel = burn(exchange, parcel, double(gas.mass[i]), entrainment, double(exposure), double(seconds));
    const float kept = float(before / parcel.mixing);
    velocity = kept * velocity + (1.0f - kept) * air; // (3)
    gas.mass[i] = float(parcel.ownMass * parcel.mixing);
    gas.entropy[i] = float(thermo.entropy(parcel));

    const float tau = float(thermo.densityRatio(parcel));
    const float ahead = 3.0f * speed / (tau * exchange.air.thermal().radius);
    const float rate =
        (exchange.def.drag + exchange.def.braking * ahead) * (kInnerDrag + (1.0f - kInnerDrag) * exposure);
    const DragStep drag = makeDragStep(double(rate), double(seconds));
    velocity = drag.decay * velocity + drag.share * air + drag.gain * buoyancyOf(exchange, tau); // (5)
    gas.vx[i] = velocity.x;
    gas.vy[i] = velocity.y;
    gas.vz[i] = velocity.z;
}

} // namespace

void exchangeWithAir(const GasExchange& exchange, const GasView<float>& gas, GasParcels& parcels,
                     float seconds, uint32_t begin, uint32_t end)
{
    GasAir::Turbulence turbulence;
    for (uint32_t first = begin; first < end; first += GasAir::Turbulence::kMax) {
        const uint32_t count = std::min(end - first, GasAir::Turbulence::kMax);
        turbulence.evaluate(exchange.air, gas, first, count);
        for (uint32_t k = 0; k < count; ++k)
            exchangeOne(exchange, gas, parcels, seconds, first + k, turbulence.at(k));
    }
}

} // namespace fx::sim
