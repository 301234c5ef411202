#include "simulation/sph/dynamics/prediction.h"

#include "simulation/parallel.h"
#include "simulation/sph/dynamics/boundary.h"

namespace fx::sim {

namespace {

template <class T>
using Axes = std::array<BoundaryAxis<T>, 3>;

/// Drifts a particle to now; one that leaves the domain is brought back for good.
template <class T>
void drift(DynamicsState<T>& s, const Axes<T>& axes, uint32_t i)
{
    GasColumns<T>& gas = s.gas;
    const T dt = T(double(s.now - gas.drifted[i]) * s.tick);
    T position[3] = {gas.x[i] + dt * gas.vx[i], gas.y[i] + dt * gas.vy[i], gas.z[i] + dt * gas.vz[i]};
    if (hasLeft(axes[0], position[0]) || hasLeft(axes[1], position[1]) || hasLeft(axes[2], position[2])) {
        base::Column<T>* const velocity[3] = {&gas.vx, &gas.vy, &gas.vz};
        base::Column<T>* const push[3] = {&gas.ax, &gas.ay, &gas.az};
        for (uint32_t a = 0; a < 3; ++a)
            if (hasLeft(axes[a], position[a]) && bringBack(axes[a], position[a])) {
                (*velocity[a])[i] = -(*velocity[a])[i];
                (*push[a])[i] = -(*push[a])[i];
            }
        gas.x[i] = position[0];
        gas.y[i] = position[1];
        gas.z[i] = position[2];
        gas.drifted[i] = s.now;
    }
    s.nowX[i] = position[0];
    s.nowY[i] = position[1];
    s.nowZ[i] = position[2];
}

/// What neighbors see of particle `i` now.
template <class T>
void fillRecord(DynamicsState<T>& s, uint32_t i)
{
    const GasColumns<T>& gas = s.gas;
    const T kicked = T(ticksSinceMiddle(s.now, gas.begin[i], gas.end[i]) * s.tick);
    const T since = T(double(s.now - gas.begin[i]) * s.tick);
    const T density = gas.density[i] * thinning(since * gas.divergence[i]);
    const T pressure = grown(gas.pressure[i], since * gas.pressureRate[i]);
    GasRecord<T>& record = s.records[i];
    record.x = s.nowX[i];
    record.y = s.nowY[i];
    record.z = s.nowZ[i];
    record.support = gas.support[i];
    record.vx = gas.vx[i] + kicked * gas.ax[i];
    record.vy = gas.vy[i] + kicked * gas.ay[i];
    record.vz = gas.vz[i] + kicked * gas.az[i];
    record.mass = gas.mass[i];
    record.push = pushOf(s, gas.correction[i], pressure, density);
    record.density = density;
    record.sound = T(s.soundScale) * gas.sound[i];
    record.viscosity = gas.viscosity[i];
    record.limiter = gas.limiter[i];
    record.energy = grown(gas.energy[i], since * gas.energyRate[i]);
    record.pressure = pressure;
    record.stepLevel = T(gas.level[i]);
}

/// What a block of places tells about itself.
template <class T>
struct BlockSummary
{
    uint32_t active = 0;
    uint64_t nextEnd = kFrameTicks;
    T speed = 0; ///< [1/s2]
};

template <class T>
BlockSummary<T> predictBlock(DynamicsState<T>& s, const Axes<T>& axes, uint32_t first, uint32_t last)
{
    BlockSummary<T> block;
    for (uint32_t i = first; i < last; ++i) {
        drift(s, axes, i);
        fillRecord(s, i);
        const GasColumns<T>& gas = s.gas;
        if (gas.end[i] == s.now)
            ++block.active;
        else
            block.nextEnd = std::min(block.nextEnd, gas.end[i]);
        const T square = gas.vx[i] * gas.vx[i] + gas.vy[i] * gas.vy[i] + gas.vz[i] * gas.vz[i];
        block.speed = std::max(block.speed, square / (gas.support[i] * gas.support[i]));
    }
    return block;
}

template <class T>
void collectActive(DynamicsState<T>& s, base::TaskRunner& tasks)
{
    const uint32_t blocks = blockCount(s.count);
    s.activeCount = 0;
    for (uint32_t b = 0; b < blocks; ++b) {
        const uint32_t size = s.blockCounts[b];
        s.blockCounts[b] = s.activeCount;
        s.activeCount += size;
    }
    parallelRows(tasks, blocks, 4, [&](uint32_t begin, uint32_t end) {
        for (uint32_t b = begin; b < end; ++b) {
            uint32_t next = s.blockCounts[b];
            for (uint32_t i = b * kBlock; i < std::min((b + 1) * kBlock, s.count); ++i)
                if (s.gas.end[i] == s.now)
                    s.active[next++] = i;
        }
    });
}

} // namespace

template <class T>
void predict(DynamicsState<T>& s, base::TaskRunner& tasks)
{
    const Axes<T> axes = boundaryAxes<T>(s.def.domain);
    const uint32_t blocks = blockCount(s.count);
    parallelRows(tasks, blocks, 1, [&](uint32_t begin, uint32_t end) {
        for (uint32_t b = begin; b < end; ++b) {
            const BlockSummary<T> block =
                predictBlock(s, axes, b * kBlock, std::min((b + 1) * kBlock, s.count));
            s.blockCounts[b] = block.active;
            s.blockEnds[b] = block.nextEnd;
            s.blockSpeeds[b] = block.speed;
        }
    });
    uint64_t nextEnd = kFrameTicks;
    T speed = 0;
    for (uint32_t b = 0; b < blocks; ++b) {
        nextEnd = std::min(nextEnd, s.blockEnds[b]);
        speed = std::max(speed, s.blockSpeeds[b]);
    }
    s.nextEnd.store(nextEnd, std::memory_order_relaxed);
    s.fastest = std::sqrt(double(speed));
    collectActive(s, tasks);
}

template void predict<float>(DynamicsState<float>&, base::TaskRunner&);
template void predict<double>(DynamicsState<double>&, base::TaskRunner&);

} // namespace fx::sim
