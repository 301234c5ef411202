#include "simulation/sph/dynamics/gas_operations.h"

#include "foundation/math/bits.h"
#include "foundation/tasks/parallel_rows.h"
#include "simulation/sph/dynamics/neighborhood.h"

#include <cmath>

namespace fx::sim {

namespace {

constexpr uint32_t kRowBatch = 1024;

/// @param louder speed of sound of the same gas over what it was in the last evaluation
template <class T>
void follow(DynamicsState<T>& s, T louder, uint32_t i)
{
    GasColumns<T>& gas = s.gas;
    s.nowX[i] = gas.x[i];
    s.nowY[i] = gas.y[i];
    s.nowZ[i] = gas.z[i];
    const StatePoint point = stateAt(s.def.state, double(gas.density[i]), double(gas.entropy[i]));
    const T values[4] = {T(point.pressure), T(point.thermal), T(point.sound), T(point.heatToEntropy)};
    if (!base::allFinite(values, 4))
        return; // the next evaluation counts it
    const T faster = louder * values[2];
    if (faster > gas.sound[i])
        gas.wantedStep[i] *= gas.sound[i] > 0 ? gas.sound[i] / faster : T(1);
    gas.pressure[i] = values[0];
    gas.energy[i] = values[1];
    gas.sound[i] = values[2];
    gas.heatToEntropy[i] = values[3];
}

} // namespace

template <class T>
void acceptNudge(DynamicsState<T>& s, double pressureScale, base::TaskRunner& tasks)
{
    if (s.fresh || s.count == 0) {
        s.stale = true;
        return;
    }
    double louder = 1.0;
    if (pressureScale > 0 && pressureScale <= 1) {
        louder = std::sqrt(pressureScale) / s.soundScale;
        s.pressureScale = pressureScale;
        s.soundScale = std::sqrt(pressureScale);
    }
    parallelRows(tasks, s.count, kRowBatch, [&](uint32_t begin, uint32_t end) {
        for (uint32_t i = begin; i < end; ++i)
            follow(s, T(louder), i);
    });
    measureWays(s, tasks);
}

template void acceptNudge<float>(DynamicsState<float>&, double, base::TaskRunner&);
template void acceptNudge<double>(DynamicsState<double>&, double, base::TaskRunner&);

} // namespace fx::sim
