#include "simulation/sph/dynamics/gas_operations.h"

#include "foundation/math/hash.h"

#include <bit>
#include <cmath>

namespace fx::sim {

namespace {

/// What advancing reads of a particle.
template <class T>
uint64_t hashParticle(const GasColumns<T>& gas, uint32_t i, uint64_t hash)
{
    const T values[] = {gas.x[i],         gas.y[i],         gas.z[i],          gas.vx[i],
                        gas.vy[i],        gas.vz[i],        gas.mass[i],       gas.entropy[i],
                        gas.ax[i],        gas.ay[i],        gas.az[i],         gas.entropyRate[i],
                        gas.support[i],   gas.density[i],   gas.divergence[i], gas.divergenceBefore[i],
                        gas.viscosity[i], gas.wantedStep[i]};
    return base::hashBytes(hash, values, sizeof(values));
}

} // namespace

template <class T>
GasTotals sumTotals(const DynamicsState<T>& s)
{
    GasTotals totals;
    const GasColumns<T>& gas = s.gas;
    for (uint32_t i = 0; i < s.count; ++i) {
        const double mass = double(gas.mass[i]);
        const glm::dvec3 velocity(gas.vx[i], gas.vy[i], gas.vz[i]);
        const double square = velocity.x * velocity.x + velocity.y * velocity.y + velocity.z * velocity.z;
        const double density = double(gas.density[i]);
        totals.mass += mass;
        totals.momentum += mass * velocity;
        totals.momentumScale += mass * std::sqrt(square);
        totals.kinetic += 0.5 * mass * square;
        totals.thermal += mass * stateAt(s.def.state, density, double(gas.entropy[i])).energy;
        totals.potential += mass * (s.def.ambientPressure / density - s.def.gravity.x * double(gas.x[i]) -
                                    s.def.gravity.y * double(gas.y[i]) - s.def.gravity.z * double(gas.z[i]));
    }
    return totals;
}

template <class T>
uint64_t hashState(const DynamicsState<T>& s)
{
    uint64_t hash = base::hashWord(s.count, std::bit_cast<uint64_t>(s.pressureScale));
    for (uint32_t id = 0; id < s.count; ++id)
        hash = hashParticle(s.gas, s.slot[id], hash);
    for (const DelayedHeat& heat : s.delayed) {
        hash = base::hashWord(hash, std::bit_cast<uint64_t>(heat.seconds));
        hash = base::hashWord(hash, std::bit_cast<uint64_t>(heat.joules));
        hash = base::hashWord(hash, heat.id);
    }
    return hash;
}

template GasTotals sumTotals<float>(const DynamicsState<float>&);
template GasTotals sumTotals<double>(const DynamicsState<double>&);
template uint64_t hashState<float>(const DynamicsState<float>&);
template uint64_t hashState<double>(const DynamicsState<double>&);

} // namespace fx::sim
