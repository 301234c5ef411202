#include "simulation/sph/dynamics/heat_input.h"

#include "foundation/math/bits.h"
#include "simulation/sph/dynamics/stepping.h"

#include <cmath>

namespace fx::sim {

namespace {

/// Delayed heat arrives on multiples of this, so that steps may stay long: a thousandth of a frame.
constexpr uint64_t kHeatTicks = kFrameTicks >> 10;

template <class T>
uint64_t tickOf(const DynamicsState<T>& s, const DelayedHeat& heat)
{
    const double parts = std::ceil(heat.seconds / (s.tick * double(kHeatTicks)));
    return uint64_t(std::min(std::max(parts, 1.0), 2048.0)) * kHeatTicks;
}

template <class T, class F>
void forEachDue(DynamicsState<T>& s, F&& f)
{
    for (DelayedHeat& heat : s.delayed)
        if (heat.isGiven == 0 && s.tick > 0 && tickOf(s, heat) <= s.now)
            f(heat);
}

} // namespace

template <class T>
void heatParticle(DynamicsState<T>& s, uint32_t i, double joules)
{
    GasColumns<T>& gas = s.gas;
    const StatePoint before = stateAt(s.def.state, double(gas.density[i]), double(gas.entropy[i]));
    const T entropy = T(double(gas.entropy[i]) + before.heatToEntropy * joules / double(gas.mass[i]));
    const StatePoint after = stateAt(s.def.state, double(gas.density[i]), double(entropy));
    const T values[4] = {entropy, T(after.pressure), T(after.thermal), T(after.sound)};
    if (!base::allFinite(values, 4) || entropy < 0) {
        s.clamped.fetch_add(1, std::memory_order_relaxed);
        return;
    }
    gas.entropy[i] = entropy;
    gas.pressure[i] = values[1];
    gas.energy[i] = values[2];
    gas.sound[i] = values[3];
    if (joules > 0)
        gas.viscosity[i] = T(s.def.viscosity.alphaMax);
}

template <class T>
uint64_t nextHeat(const DynamicsState<T>& s)
{
    uint64_t next = kFrameTicks;
    for (const DelayedHeat& heat : s.delayed)
        if (heat.isGiven == 0)
            next = std::min(next, tickOf(s, heat));
    return next;
}

template <class T>
void wakeHeated(DynamicsState<T>& s)
{
    forEachDue(s, [&s](DelayedHeat& heat) {
        const uint32_t i = s.slot[heat.id];
        if (s.gas.end[i] != s.now)
            endStepNow(s, i, 0);
        s.heatedNow = true;
    });
}

template <class T>
void giveDelayedHeat(DynamicsState<T>& s)
{
    forEachDue(s, [&s](DelayedHeat& heat) {
        heatParticle(s, s.slot[heat.id], heat.joules);
        heat.isGiven = 1;
    });
}

template <class T>
void passTime(DynamicsState<T>& s, double seconds)
{
    std::erase_if(s.delayed, [](const DelayedHeat& heat) { return heat.isGiven != 0; });
    for (DelayedHeat& heat : s.delayed)
        heat.seconds -= seconds;
}

#define FX_INSTANTIATE(T)                                                                                    \
    template void heatParticle<T>(DynamicsState<T>&, uint32_t, double);                                      \
    template uint64_t nextHeat<T>(const DynamicsState<T>&);                                                  \
    template void wakeHeated<T>(DynamicsState<T>&);                                                          \
    template void giveDelayedHeat<T>(DynamicsState<T>&);                                                     \
    template void passTime<T>(DynamicsState<T>&, double);
FX_INSTANTIATE(float)
FX_INSTANTIATE(double)
#undef FX_INSTANTIATE

} // namespace fx::sim
