#include "simulation/sph/dynamics/stepping.h"

#include "foundation/tasks/parallel_rows.h"
#include "simulation/sph/dynamics/stepping.h"

#include <algorithm>
#include <cmath>

namespace fx::sim {

namespace {

constexpr uint32_t kRowBatch = 1024;
constexpr uint32_t kPairBatch = 128;
constexpr uint8_t kNoLimit = 255;
constexpr uint32_t kMaxLevels = 200; ///< of wanted steps, which may be longer than a frame

/// Difference of levels that the limiter allows; a large number where it is off.
uint32_t allowedDifference(const GasDynamicsDef& def)
{
    return def.neighborStepRatio < 1e9 ? stepLevel(def.neighborStepRatio) : kNoLimit;
}

/// Longest level of all, of which the active slots can only limit longer ones.
template <class T>
uint32_t longestLevel(const DynamicsState<T>& s, base::TaskRunner& tasks)
{
    std::atomic<uint32_t> longest{0};
    parallelRows(tasks, s.count, kBlock, [&](uint32_t begin, uint32_t end) {
        const uint8_t* const level = s.gas.level.data();
        raiseTo(longest, uint32_t(*std::max_element(level + begin, level + end)));
    });
    return longest.load();
}

/// Offers every neighbor of the active slots the longest level that they allow, into levelLimit.
template <class T>
void offerLimits(DynamicsState<T>& s, uint32_t difference, base::TaskRunner& tasks)
{
    const uint32_t longest = longestLevel(s, tasks);
    parallelRows(tasks, s.activeCount, kPairBatch, [&s, difference, longest](uint32_t begin, uint32_t end) {
        for (uint32_t k = begin; k < end; ++k) {
            const uint32_t i = s.active[k];
            const uint8_t limit = uint8_t(std::min(s.gas.level[i] + difference, uint32_t(kNoLimit)));
            if (limit >= longest)
                continue; // no step is long enough
            s.lists.forEachPiece(i, [&](const uint32_t* entries, uint32_t count, bool) {
                for (uint32_t n = 0; n < count; ++n) {
                    const uint32_t j = entries[n] & kPlaceMask;
                    if (s.gas.level[j] <= limit)
                        continue;
                    std::atomic_ref<uint8_t> offered(s.levelLimit[j]);
                    uint8_t seen = offered.load(std::memory_order_relaxed);
                    while (limit < seen &&
                           !offered.compare_exchange_weak(seen, limit, std::memory_order_relaxed)) {
                    }
                }
            });
        }
    });
}

template <class T>
void clearLimits(DynamicsState<T>& s)
{
    std::fill_n(s.levelLimit.data(), s.count, kNoLimit);
}

} // namespace

template <class T>
void chooseLevels(DynamicsState<T>& s, base::TaskRunner& tasks)
{
    const uint32_t difference = allowedDifference(s.def);
    parallelRows(tasks, s.activeCount, kRowBatch, [&s, difference](uint32_t begin, uint32_t end) {
        for (uint32_t k = begin; k < end; ++k) {
            const uint32_t i = s.active[k];
            const uint32_t wanted = stepLevel(double(s.gas.wantedStep[i]) / s.tick);
            uint32_t allowed = std::min(wanted, uint32_t(s.fastestNeighbor[i]) + difference);
            if (s.now > 0)
                allowed = std::min(allowed, s.gas.level[i] + 1u); // a step is at most twice the one before
            s.gas.level[i] = uint8_t(alignedLevel(std::min(allowed, kFrameLevel), s.now));
        }
    });
}

template <class T>
uint32_t wakeNeighbors(DynamicsState<T>& s, base::TaskRunner& tasks)
{
    const uint32_t difference = allowedDifference(s.def);
    if (s.def.steps == StepScheme::Global || difference >= kFrameLevel || !s.listsServeActive)
        return 0;
    clearLimits(s);
    offerLimits(s, difference, tasks);
    parallelRows(tasks, s.count, kRowBatch, [&s, difference](uint32_t begin, uint32_t end) {
        uint64_t nextEnd = kFrameTicks;
        for (uint32_t j = begin; j < end; ++j) {
            if (s.levelLimit[j] == kNoLimit)
                continue;
            if (s.gas.begin[j] == s.now) { // awake: has just chosen
                s.gas.level[j] = s.levelLimit[j];
                shortenStep(s, j, s.now + (uint64_t(1) << s.gas.level[j]));
                nextEnd = std::min(nextEnd, s.gas.end[j]);
                s.levelLimit[j] = kNoLimit;
            } else
            { // asleep, in a long step, however soon it ends. Heat of this tick has moved no particle yet
                endStepNow(s, j, s.heatedNow ? 0 : uint64_t(1) << (s.levelLimit[j] - difference));
            }
        }
        lowerTo(s.nextEnd, nextEnd);
    });
    s.activeCount = 0;
    for (uint32_t j = 0; j < s.count; ++j)
        if (s.levelLimit[j] != kNoLimit)
            s.active[s.activeCount++] = j;
    return s.activeCount;
}

template <class T>
void limitWantedSteps(DynamicsState<T>& s, base::TaskRunner& tasks)
{
    const uint32_t difference = allowedDifference(s.def);
    if (difference >= kFrameLevel || s.def.steps == StepScheme::Global)
        return;
    const double unit = shortestStep(s, tasks); // level 0: nothing is shorter
    parallelRows(tasks, s.count, kRowBatch, [&s, unit](uint32_t begin, uint32_t end) {
        for (uint32_t i = begin; i < end; ++i)
            s.gas.level[i] = uint8_t(stepLevel(double(s.gas.wantedStep[i]) / unit, kMaxLevels));
    });
    clearLimits(s);
    offerLimits(s, difference, tasks);
    parallelRows(tasks, s.count, kRowBatch, [&s, unit](uint32_t begin, uint32_t end) {
        for (uint32_t i = begin; i < end; ++i)
            if (s.levelLimit[i] != kNoLimit)
                s.gas.wantedStep[i] =
                    std::min(s.gas.wantedStep[i], T(std::ldexp(unit, int(s.levelLimit[i]))));
    });
}

#define FX_INSTANTIATE(T)                                                                                    \
    template void chooseLevels<T>(DynamicsState<T>&, base::TaskRunner&);                                     \
    template uint32_t wakeNeighbors<T>(DynamicsState<T>&, base::TaskRunner&);                                \
    template void limitWantedSteps<T>(DynamicsState<T>&, base::TaskRunner&);
FX_INSTANTIATE(float)
FX_INSTANTIATE(double)
#undef FX_INSTANTIATE

} // namespace fx::sim
