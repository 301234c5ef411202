#include "simulation/sph/dynamics/prediction.h"

#include "foundation/tasks/parallel_rows.h"
#include "simulation/sph/dynamics/boundary.h"

#include <algorithm>
#include <cmath>

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

/// [m/s] Of an ideal gas c^2 = g (g - 1) u; others keep theirs for the step.
template <class T>
T soundOf(const DynamicsState<T>& s, uint32_t i, T energy)
{
    const StateEquation& state = s.def.state;
    if (state.stiffness != 0 || state.jwlA != 0 || state.jwlB != 0)
        return s.gas.sound[i];
    return std::sqrt(T(state.gamma * (state.gamma - 1.0)) * energy);
}

/// What neighbors see of particle `i` now.
template <class T>
void fillRecord(DynamicsState<T>& s, uint32_t i)
{
    const GasColumns<T>& gas = s.gas;
    const T kicked = T(ticksSinceMiddle(s.now, gas.begin[i], gas.end[i]) * s.tick);
    const T since = T(double(s.now - gas.begin[i]) * s.tick);
    const T density = gas.density[i] * thinning(since * gas.expansion[i]);
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
    record.energy = grown(gas.energy[i], since * gas.energyRate[i]);
    record.sound = T(s.soundScale) * soundOf(s, i, record.energy);
    record.viscosity = gas.viscosity[i];
    record.limiter = gas.limiter[i];
    record.pressure = pressure;
    record.stepLevel = T(gas.level[i]);
}

constexpr uint32_t kMin = 6; ///< all records are filled where more than one in so many is active
constexpr uint32_t kPairBatch = 128;

/// Fills the record of `i` if it belongs to an earlier prediction; done once, by the first thread.
template <class T>
void fillOnce(DynamicsState<T>& s, uint32_t i)
{
    std::atomic_ref<uint32_t> round(s.recordRound[i]);
    if (round.load(std::memory_order_relaxed) != s.round &&
        round.exchange(s.round, std::memory_order_relaxed) != s.round)
        fillRecord(s, i);
}

/// What a block of slots tells about itself.
template <class T>
struct BlockSummary
{
    uint32_t active = 0;
    uint64_t nextEnd = kFrameTicks;
    T speed = 0; ///< [1/s2]
};

/// Whether all steps in a block go on and no particle has moved by more than kStill since its last visit.
template <class T>
bool canPassOver(const DynamicsState<T>& s, uint32_t b)
{
    constexpr double kStill = sizeof(T) == sizeof(double) ? 1e-12 : 1e-5; // of a support
    if (s.blockChanged[b] != 0 || s.blockEnds[b] <= s.now)
        return false;
    const double seconds = double(s.now - s.blockNow[b]) * s.tick;
    return double(s.blockSpeeds[b]) * seconds * seconds <= kStill * kStill;
}

template <class T>
BlockSummary<T> predictBlock(DynamicsState<T>& s, const Axes<T>& axes, uint32_t first, uint32_t last)
{
    BlockSummary<T> block;
    for (uint32_t i = first; i < last; ++i) {
        drift(s, axes, i);
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
            if (next == (b + 1 < blocks ? s.blockCounts[b + 1] : s.activeCount))
                continue;
            for (uint32_t i = b * kBlock; i < std::min((b + 1) * kBlock, s.count); ++i)
                if (s.gas.end[i] == s.now)
                    s.active[next++] = i;
        }
    });
}

/// Records of all, or of the active ones where these are few.
template <class T>
void fillFirst(DynamicsState<T>& s, base::TaskRunner& tasks)
{
    s.recordsAreComplete = uint64_t(s.activeCount) * kMin > s.count;
    if (++s.round == 0) { // numbers have been used up
        std::fill_n(s.recordRound.data(), s.recordRound.capacity(), 0u);
        s.round = 1;
    }
    if (s.recordsAreComplete) {
        parallelRows(tasks, s.count, kBlock, [&s](uint32_t begin, uint32_t end) {
            for (uint32_t i = begin; i < end; ++i)
                fillRecord(s, i);
        });
        return;
    }
    parallelRows(tasks, s.activeCount, kPairBatch, [&s](uint32_t begin, uint32_t end) {
        for (uint32_t k = begin; k < end; ++k)
            fillOnce(s, s.active[k]);
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
            s.blockCounts[b] = 0;
            if (canPassOver(s, b))
                continue;
            const BlockSummary<T> block =
                predictBlock(s, axes, b * kBlock, std::min((b + 1) * kBlock, s.count));
            s.blockCounts[b] = block.active;
            s.blockEnds[b] = block.nextEnd;
            s.blockSpeeds[b] = block.speed;
            s.blockNow[b] = s.now;
            s.blockChanged[b] = block.active > 0; // they will open new steps
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
    fillFirst(s, tasks);
}

template <class T>
void fillSeen(DynamicsState<T>& s, std::span<const uint32_t> owners, base::TaskRunner& tasks)
{
    if (s.recordsAreComplete)
        return;
    parallelRows(tasks, uint32_t(owners.size()), kPairBatch, [&](uint32_t begin, uint32_t end) {
        for (const uint32_t i : owners.subspan(begin, end - begin))
            s.lists.forEachPiece(i, [&](const uint32_t* entries, uint32_t count, bool) {
                for (uint32_t n = 0; n < count; ++n)
                    fillOnce(s, entries[n] & kPlaceMask);
            });
    });
}

#define FX_INSTANTIATE(T)                                                                                    \
    template void predict<T>(DynamicsState<T>&, base::TaskRunner&);                                          \
    template void fillSeen<T>(DynamicsState<T>&, std::span<const uint32_t>, base::TaskRunner&);
FX_INSTANTIATE(float)
FX_INSTANTIATE(double)
#undef FX_INSTANTIATE

} // namespace fx::sim
