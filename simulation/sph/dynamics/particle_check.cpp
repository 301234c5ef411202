#include "simulation/sph/dynamics/gas_operations.h"

#include "foundation/math/bits.h"

#include <cmath>

namespace fx::sim {

namespace {

constexpr double kFarthest = 1e9;   ///< [m], and [m/s] of velocities
constexpr double kMaxMass = 1e20;   ///< [kg]
constexpr double kMinMass = 1e-20;  ///< [kg]
constexpr double kMaxEnergy = 1e18; ///< [J/kg]

base::Status refuse(const char* why)
{
    return {base::Code::InvalidArgument, why};
}

/// False for NaN.
bool isWithin(double value, double low, double high)
{
    return base::isFinite(value) && value >= low && value <= high;
}

} // namespace

base::Status checkParticle(const GasParticle& particle, const Domain& domain)
{
    for (int a = 0; a < 3; ++a) {
        const double x = particle.position[a];
        if (!isWithin(x, -kFarthest, kFarthest))
            return refuse("the position of a gas particle must be finite and within 1e9 m");
        if (domain.axes[size_t(a)] != AxisKind::Open && !(x >= domain.low[a] && x <= domain.high[a]))
            return refuse("the position of a gas particle must lie in the domain");
        if (!isWithin(particle.velocity[a], -kFarthest, kFarthest))
            return refuse("the velocity of a gas particle must be finite and within 1e9 m/s");
    }
    if (!isWithin(particle.mass, kMinMass, kMaxMass))
        return refuse("the mass of a gas particle must lie between 1e-20 and 1e20 kg");
    if (!isWithin(particle.energy, 0.0, kMaxEnergy))
        return refuse("the energy of a gas particle must lie between 0 and 1e18 J/kg");
    return {};
}

base::Status checkGasDynamicsDef(const GasDynamicsDef& def)
{
    if (def.capacity < 1 || def.capacity > (1u << 28))
        return refuse("a gas has room for 1 to 2^28 particles");
    if (!isWithin(def.neighbors, 8, 1000))
        return refuse("a gas particle has 8 to 1000 neighbors");
    if (!isWithin(def.state.gamma, 1.0 + 1e-6, 10.0) || !isWithin(def.state.stiffness, 0, 1e15) ||
        !isWithin(def.state.jwlA, 0, 1e15) || !isWithin(def.state.jwlB, 0, 1e15) ||
        !isWithin(def.state.referenceDensity, 1e-20, 1e20))
        return refuse("the state equation of a gas is out of range");
    if ((def.state.jwlA > 0 && !isWithin(def.state.jwlR1, 1e-6, 1e3)) ||
        (def.state.jwlB > 0 && !isWithin(def.state.jwlR2, 1e-6, 1e3)))
        return refuse("a JWL curve needs positive R1 and R2");
    const ViscosityRules& viscosity = def.viscosity;
    if (!isWithin(viscosity.alphaMin, 0, 100) || !isWithin(viscosity.alphaMax, viscosity.alphaMin, 100) ||
        !isWithin(viscosity.decay, 0, 100) || !isWithin(viscosity.beta, 0, 100) ||
        !isWithin(viscosity.conductivity, 0, 100))
        return refuse("the viscosity rules of a gas are out of range");
    if (!isWithin(def.courant, 1e-6, 1.0) || !isWithin(def.volumeChange, 1e-6, 1.0) ||
        !(def.neighborStepRatio >= 1.0) || def.maxSubSteps < 1)
        return refuse("the time steps of a gas are out of range");
    if (!isWithin(def.smallestSupport, 0, 1e30) || !isWithin(def.largestSupport, 1e-30, 1e30) ||
        def.smallestSupport > def.largestSupport)
        return refuse("the supports of a gas are out of range");
    for (int a = 0; a < 3; ++a) {
        if (!isWithin(def.gravity[a], -1e9, 1e9))
            return refuse("the gravity of a gas must be finite");
        const bool isPeriodic = def.domain.axes[size_t(a)] == AxisKind::Periodic;
        if (!(def.domain.low[a] < def.domain.high[a]) ||
            (isPeriodic && !base::isFinite(def.domain.high[a] - def.domain.low[a])))
            return refuse("the domain of a gas must have low below high, and finite periodic axes");
    }
    if (!isWithin(def.ambientPressure, 0, 1e15))
        return refuse("the ambient pressure of a gas must be finite and not negative");
    return {};
}

template <class T>
void appendParticle(DynamicsState<T>& s, const GasParticle& particle)
{
    const uint32_t i = s.count++;
    GasColumns<T>& gas = s.gas;
    gas.forEachLasting([i](auto& column) { column[i] = 0; });
    gas.id[i] = i;
    gas.x[i] = T(particle.position.x);
    gas.y[i] = T(particle.position.y);
    gas.z[i] = T(particle.position.z);
    gas.vx[i] = T(particle.velocity.x);
    gas.vy[i] = T(particle.velocity.y);
    gas.vz[i] = T(particle.velocity.z);
    gas.mass[i] = T(particle.mass);
    gas.energy[i] = T(particle.energy);
    gas.support[i] = T(1);
    gas.density[i] = T(1);
    gas.correction[i] = T(1);
    gas.viscosity[i] = T(-1); // no past
    gas.begin[i] = gas.end[i] = gas.drifted[i] = 0;
    gas.level[i] = 0;
    s.slot[i] = i;
    s.sortedX[i] = gas.x[i];
    s.sortedY[i] = gas.y[i];
    s.sortedZ[i] = gas.z[i];
    s.sortedSupport[i] = T(1);
}

template void appendParticle<float>(DynamicsState<float>&, const GasParticle&);
template void appendParticle<double>(DynamicsState<double>&, const GasParticle&);

} // namespace fx::sim
