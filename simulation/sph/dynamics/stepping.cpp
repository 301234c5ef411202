#include "simulation/sph/dynamics/stepping.h"

#include "foundation/math/bits.h"
#include "foundation/tasks/parallel_rows.h"

#include <algorithm>
#include <cmath>

namespace fx::sim {

namespace {

constexpr uint32_t kRowBatch = 1024;

/// Adds `seconds` times the rates to velocity and entropy, unless that gives no number.
template <class T>
void kick(DynamicsState<T>& s, uint32_t i, T seconds)
{
    GasColumns<T>& gas = s.gas;
    const T next[4] = {gas.vx[i] + seconds * gas.ax[i], gas.vy[i] + seconds * gas.ay[i],
                       gas.vz[i] + seconds * gas.az[i], gas.entropy[i] + seconds * gas.entropyRate[i]};
    if (!base::allFinite(next, 4)) {
        s.clamped.fetch_add(1, std::memory_order_relaxed);
        return;
    }
    gas.vx[i] = next[0];
    gas.vy[i] = next[1];
    gas.vz[i] = next[2];
    if (next[3] < 0)
        s.clamped.fetch_add(1, std::memory_order_relaxed);
    gas.entropy[i] = next[3] < 0 ? T(0.1) * gas.entropy[i] : next[3];
}

template <class T>
void openStep(DynamicsState<T>& s, uint32_t i, uint64_t length)
{
    s.gas.begin[i] = s.now;
    s.gas.end[i] = s.now + length;
    kick(s, i, T(0.5 * double(length) * s.tick));
}

/// Lets the position hold for now: the drift so far was done with the old velocity.
template <class T>
void moveToNow(DynamicsState<T>& s, uint32_t slot)
{
    GasColumns<T>& gas = s.gas;
    const T dt = T(double(s.now - gas.drifted[slot]) * s.tick);
    gas.x[slot] += dt * gas.vx[slot];
    gas.y[slot] += dt * gas.vy[slot];
    gas.z[slot] += dt * gas.vz[slot];
    gas.drifted[slot] = s.now;
}

/// Length of the next step of all, where all have the same: what is left of the frame in equal parts.
template <class T>
uint64_t commonStep(DynamicsState<T>& s, base::TaskRunner& tasks)
{
    const uint64_t left = kFrameTicks - s.now;
    const double parts = std::ceil(double(left) * s.tick / shortestStep(s, tasks));
    if (!(parts > 1.0))
        return left;
    return std::max<uint64_t>(uint64_t(std::ceil(double(left) / std::min(parts, double(left)))), 1);
}

} // namespace

template <class T>
void closeSteps(DynamicsState<T>& s, base::TaskRunner& tasks)
{
    parallelRows(tasks, s.activeCount, kRowBatch, [&s](uint32_t begin, uint32_t end) {
        GasColumns<T>& gas = s.gas;
        for (uint32_t k = begin; k < end; ++k) {
            const uint32_t i = s.active[k];
            kick(s, i, T(ticksSinceMiddle(s.now, gas.begin[i], gas.end[i]) * s.tick));
            const T position[3] = {s.nowX[i], s.nowY[i], s.nowZ[i]};
            gas.drifted[i] = s.now;
            if (!base::allFinite(position, 3)) {
                s.clamped.fetch_add(1, std::memory_order_relaxed);
                gas.vx[i] = gas.vy[i] = gas.vz[i] = 0;
                continue;
            }
            gas.x[i] = position[0];
            gas.y[i] = position[1];
            gas.z[i] = position[2];
        }
    });
}

template <class T>
void openSteps(DynamicsState<T>& s, base::TaskRunner& tasks)
{
    if (s.def.steps == StepScheme::Global) {
        const uint64_t length = commonStep(s, tasks);
        s.nextEnd = s.now + length;
        parallelRows(tasks, s.activeCount, kRowBatch, [&s, length](uint32_t begin, uint32_t end) {
            for (uint32_t k = begin; k < end; ++k)
                openStep(s, s.active[k], length);
        });
        return;
    }
    chooseLevels(s, tasks);
    parallelRows(tasks, s.activeCount, kRowBatch, [&s](uint32_t begin, uint32_t end) {
        uint64_t nextEnd = kFrameTicks;
        for (uint32_t k = begin; k < end; ++k) {
            const uint32_t i = s.active[k];
            openStep(s, i, uint64_t(1) << s.gas.level[i]);
            nextEnd = std::min(nextEnd, s.gas.end[i]);
        }
        lowerTo(s.nextEnd, nextEnd);
    });
}

template <class T>
void shortenStep(DynamicsState<T>& s, uint32_t slot, uint64_t end)
{
    GasColumns<T>& gas = s.gas;
    moveToNow(s, slot);
    kick(s, slot, T(0.5 * (double(end) - double(gas.end[slot])) * s.tick)); // (3)
    gas.end[slot] = end;
    markChanged(s, slot);
}

template <class T>
void endStepNow(DynamicsState<T>& s, uint32_t slot, uint64_t lately)
{
    GasColumns<T>& gas = s.gas;
    const uint64_t begin = s.now - std::min(lately, s.now - gas.begin[slot]);
    moveToNow(s, slot);
    if (s.blockNow[slot / kBlock] != s.now) { // its block has hardly moved and was passed over
        s.nowX[slot] = gas.x[slot];
        s.nowY[slot] = gas.y[slot];
        s.nowZ[slot] = gas.z[slot];
    }
    const double ticks =
        ticksSinceMiddle(s.now, gas.begin[slot], gas.end[slot]) - 0.5 * double(s.now - begin);
    kick(s, slot, T(ticks * s.tick));
    gas.begin[slot] = begin;
    gas.end[slot] = s.now;
    markChanged(s, slot);
}

template <class T>
void openFrame(DynamicsState<T>& s, double seconds, base::TaskRunner& tasks)
{
    s.now = 0;
    s.tick = seconds / double(kFrameTicks);
    parallelRows(tasks, s.count, kRowBatch, [&s](uint32_t begin, uint32_t end) {
        for (uint32_t i = begin; i < end; ++i) {
            s.gas.begin[i] = s.gas.end[i] = s.gas.drifted[i] = 0;
            s.active[i] = i;
            s.fastestNeighbor[i] =
                T(kFrameLevel); // wanted steps have been limited at the end of the last frame
        }
    });
    std::fill_n(s.blockChanged.data(), blockCount(s.count), uint8_t(1));
    s.activeCount = s.count;
    s.nextEnd = kFrameTicks;
    s.listsServeActive = false;
    openSteps(s, tasks);
}

template <class T>
double shortestStep(DynamicsState<T>& s, base::TaskRunner& tasks)
{
    std::atomic<uint64_t> shortest{std::bit_cast<uint64_t>(kEndless)};
    parallelRows(tasks, s.count, kRowBatch, [&](uint32_t begin, uint32_t end) {
        T least = T(kEndless);
        for (uint32_t i = begin; i < end; ++i)
            least = std::min(least, s.gas.wantedStep[i]);
        lowerTo(shortest, std::bit_cast<uint64_t>(double(least))); // bits of positive numbers are in order
    });
    return std::bit_cast<double>(shortest.load());
}

#define FX_INSTANTIATE(T)                                                                                    \
    template void closeSteps<T>(DynamicsState<T>&, base::TaskRunner&);                                       \
    template void openSteps<T>(DynamicsState<T>&, base::TaskRunner&);                                        \
    template void shortenStep<T>(DynamicsState<T>&, uint32_t, uint64_t);                                     \
    template void endStepNow<T>(DynamicsState<T>&, uint32_t, uint64_t);                                      \
    template void openFrame<T>(DynamicsState<T>&, double, base::TaskRunner&);                                \
    template double shortestStep<T>(DynamicsState<T>&, base::TaskRunner&);
FX_INSTANTIATE(float)
FX_INSTANTIATE(double)
#undef FX_INSTANTIATE

} // namespace fx::sim
