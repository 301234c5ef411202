#include "simulation/sph/dynamics/gas_dynamics.h"

#include "foundation/math/bits.h"
#include "foundation/simd/floating_point_scope.h"
#include "simulation/sph/dynamics/gas_operations.h"
#include "simulation/sph/dynamics/heat_input.h"
#include "simulation/sph/dynamics/shifting.h"

#include <algorithm>
#include <cmath>

namespace fx::sim {

namespace {

template <class V, class T>
GasView<V> viewOf(GasColumns<T>& gas, uint32_t count)
{
    return {count,
            gas.id.data(),
            gas.x.data(),
            gas.y.data(),
            gas.z.data(),
            gas.vx.data(),
            gas.vy.data(),
            gas.vz.data(),
            gas.mass.data(),
            gas.entropy.data(),
            gas.support.data(),
            gas.density.data(),
            gas.pressure.data(),
            gas.energy.data(),
            gas.divergence.data(),
            gas.curl.data(),
            gas.viscosity.data(),
            gas.exposure.data()};
}

} // namespace

template <class T>
GasDynamics<T>::GasDynamics(const GasDynamicsDef& def, std::pmr::memory_resource* memory)
    : state_(std::make_unique<DynamicsState<T>>(def, memory))
{}

template <class T>
GasDynamics<T>::~GasDynamics() = default;

template <class T>
base::Status GasDynamics<T>::add(std::span<const GasParticle> particles)
{
    DynamicsState<T>& s = *state_;
    if (particles.size() > s.def.capacity - s.count)
        return {base::Code::Capacity, "more gas particles than the definition has room for"};
    for (const GasParticle& particle : particles)
        if (base::Status status = checkParticle(particle, s.def.domain); !status)
            return status;
    for (const GasParticle& particle : particles)
        appendParticle(s, particle);
    s.fresh = s.fresh || !particles.empty();
    s.shaken = s.shaken || s.fresh;
    return {};
}

template <class T>
void GasDynamics<T>::initialize(base::TaskRunner& tasks)
{
    const base::FloatingPointScope floatingPoint;
    prepare(*state_, tasks);
}

template <class T>
base::Result<AdvanceReport> GasDynamics<T>::advance(double seconds, base::TaskRunner& tasks,
                                                    base::WorkBudget& work)
{
    if (!base::isFinite(seconds) || seconds < 0)
        return base::Status(base::Code::InvalidArgument,
                            "a gas advances by a finite time that is not negative");
    if (seconds == 0)
        return AdvanceReport{};
    const base::FloatingPointScope floatingPoint;
    return runFrames(*state_, seconds, tasks, work);
}

template <class T>
bool GasDynamics<T>::isAdvancing() const
{
    return state_->advance.isOpen;
}

template <class T>
void GasDynamics<T>::abandonAdvance()
{
    state_->advance = {};
}

template <class T>
void GasDynamics<T>::inject(uint32_t id, double joules)
{
    const base::FloatingPointScope floatingPoint;
    DynamicsState<T>& s = *state_;
    const uint32_t i = s.slot[id];
    if (s.gas.viscosity[i] < 0) { // no density yet, its energy waits
        const T energy = T(double(s.gas.energy[i]) + joules / double(s.gas.mass[i]));
        if (base::isFinite(energy) && energy >= 0)
            s.gas.energy[i] = energy;
        return;
    }
    heatParticle(s, i, joules);
    s.stale = s.shaken = true;
}

template <class T>
void GasDynamics<T>::injectLater(uint32_t id, double joules, double delay)
{
    if (!(delay > 0))
        return inject(id, joules);
    const auto later = std::find_if(state_->delayed.begin(), state_->delayed.end(),
                                    [delay](const DelayedHeat& heat) { return heat.seconds > delay; });
    state_->delayed.insert(later, DelayedHeat{delay, joules, id, 0});
}

template <class T>
void GasDynamics<T>::setEnergy(uint32_t id, double energy)
{
    const base::FloatingPointScope floatingPoint;
    DynamicsState<T>& s = *state_;
    const uint32_t i = s.slot[id];
    if (s.gas.viscosity[i] < 0) {
        s.gas.energy[i] = T(energy);
        return;
    }
    const double density = double(s.gas.density[i]);
    s.gas.entropy[i] = T(entropyOf(s.def.state, density, energy));
    const StatePoint point = stateAt(s.def.state, density, double(s.gas.entropy[i]));
    s.gas.pressure[i] = T(point.pressure);
    s.gas.energy[i] = T(point.thermal);
    s.gas.sound[i] = T(point.sound);
    s.stale = true;
}

template <class T>
void GasDynamics<T>::edited()
{
    state_->stale = true;
}

template <class T>
void GasDynamics<T>::setPressureScale(double scale)
{
    if (!(scale > 0 && scale <= 1) || scale == state_->pressureScale)
        return;
    state_->pressureScale = scale;
    state_->soundScale = std::sqrt(scale);
    state_->stale = true;
}

template <class T>
void GasDynamics<T>::nudged(double pressureScale, base::TaskRunner& tasks)
{
    const base::FloatingPointScope floatingPoint;
    acceptNudge(*state_, pressureScale, tasks);
}

template <class T>
void GasDynamics<T>::shift(double strength, double longest, base::TaskRunner& tasks)
{
    const base::FloatingPointScope floatingPoint;
    shiftParticles(*state_, strength, longest, tasks);
}

template <class T>
double GasDynamics<T>::pressureScale() const
{
    return state_->pressureScale;
}

template <class T>
uint32_t GasDynamics<T>::count() const
{
    return state_->count;
}

template <class T>
const GasDynamicsDef& GasDynamics<T>::definition() const
{
    return state_->def;
}

template <class T>
GasView<T> GasDynamics<T>::view()
{
    return viewOf<T>(state_->gas, state_->count);
}

template <class T>
GasView<const T> GasDynamics<T>::view() const
{
    return viewOf<const T>(state_->gas, state_->count);
}

template <class T>
uint32_t GasDynamics<T>::placeOf(uint32_t id) const
{
    return state_->slot[id];
}

template <class T>
GasParticle GasDynamics<T>::particle(uint32_t id) const
{
    const GasColumns<T>& gas = state_->gas;
    const uint32_t i = state_->slot[id];
    const double energy =
        gas.viscosity[i] < 0
            ? double(gas.energy[i])
            : stateAt(state_->def.state, double(gas.density[i]), double(gas.entropy[i])).energy;
    return {{gas.x[i], gas.y[i], gas.z[i]}, {gas.vx[i], gas.vy[i], gas.vz[i]}, double(gas.mass[i]), energy};
}

template <class T>
double GasDynamics<T>::densityOf(uint32_t id) const
{
    return double(state_->gas.density[state_->slot[id]]);
}

template <class T>
double GasDynamics<T>::pressureOf(uint32_t id) const
{
    return double(state_->gas.pressure[state_->slot[id]]);
}

template <class T>
double GasDynamics<T>::supportOf(uint32_t id) const
{
    return double(state_->gas.support[state_->slot[id]]);
}

template <class T>
double GasDynamics<T>::stepOf(uint32_t id) const
{
    return double(state_->gas.wantedStep[state_->slot[id]]);
}

template <class T>
GasTotals GasDynamics<T>::totals() const
{
    const base::FloatingPointScope floatingPoint;
    return sumTotals(*state_);
}

template <class T>
uint64_t GasDynamics<T>::hash() const
{
    return hashState(*state_);
}

template <class T>
void GasDynamics<T>::save(std::vector<std::byte>& out) const
{
    saveState(*state_, out);
}

template <class T>
base::Status GasDynamics<T>::restore(std::span<const std::byte> bytes)
{
    return restoreState(*state_, bytes);
}

template class GasDynamics<float>;
template class GasDynamics<double>;

} // namespace fx::sim
