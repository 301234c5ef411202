#include "simulation/sph/dynamics/evaluation.h"

#include "foundation/math/elementary.h"
#include "foundation/tasks/parallel_rows.h"
#include "simulation/sph/dynamics/evaluation.h"
#include "simulation/sph/dynamics/neighborhood.h"
#include "simulation/sph/dynamics/prediction.h"

#include <algorithm>

namespace fx::sim {

namespace {

constexpr uint32_t kWindow = 8; ///< slots along the curve that show how dense the particles are
constexpr double kReach = 0.25;

/// True for a particle that has been added and not yet seen its neighbors.
template <class T>
bool isNew(const DynamicsState<T>& state, uint32_t slot)
{
    return state.gas.viscosity[slot] < 0;
}

/// Longest side of the box around the slots [first, last].
template <class T>
T extent(const DynamicsState<T>& s, uint32_t first, uint32_t last)
{
    T longest = 0;
    for (const base::Column<T>* x : {&s.nowX, &s.nowY, &s.nowZ}) {
        const auto [low, high] = std::minmax_element(x->data() + first, x->data() + last + 1);
        longest = std::max(longest, *high - *low);
    }
    return longest;
}

/// Support from the slots before and after along the curve; a jump of the curve spoils only one side.
template <class T>
void guessFirstSupports(DynamicsState<T>& s, base::TaskRunner& tasks)
{
    const uint32_t window = std::min(kWindow, s.count - 1);
    const T perExtent = T(base::cubeRoot(3.0 * s.def.neighbors / (12.566370614359172 * (kWindow + 1))));
    parallelRows(tasks, s.count, 1024, [&](uint32_t begin, uint32_t end) {
        for (uint32_t i = begin; i < end; ++i) {
            if (!isNew(s, i))
                continue;
            const T before = extent(s, std::max(i, window) - window, std::max(i, window));
            const uint32_t last = std::min(i + window, s.count - 1);
            const T after = extent(s, last - window, last);
            s.gas.support[i] = perExtent * std::min(before, after);
        }
    });
}

/// Bounds that the definition leaves open, from the median of the guesses, and guesses within the bounds.
template <class T>
void boundSupports(DynamicsState<T>& s)
{
    std::copy_n(s.gas.support.data(), s.count, s.heating.data());
    T* const middle = s.heating.data() + s.count / 2;
    std::nth_element(s.heating.data(), middle, s.heating.data() + s.count);
    const double median = *middle > 0 ? double(*middle) : 1.0;
    DensityRules& rules = s.densityRules;
    if (!(s.def.smallestSupport > 0))
        rules.smallestSupport = std::min(1e-4 * median, rules.largestSupport);
    if (s.def.largestSupport >= kEndless)
        rules.largestSupport =
            std::min(std::max(200.0 * median, rules.smallestSupport), largestInDomain(s.def));
    for (uint32_t i = 0; i < s.count; ++i)
        s.gas.support[i] =
            std::min(std::max(s.gas.support[i], T(rules.smallestSupport)), T(rules.largestSupport));
}

/// Keeps those of the active slots that satisfy `condition`.
template <class T, class F>
void keepActive(DynamicsState<T>& s, F&& condition)
{
    uint32_t kept = 0;
    for (uint32_t k = 0; k < s.activeCount; ++k)
        if (condition(s.active[k]))
            s.active[kept++] = s.active[k];
    s.activeCount = kept;
}

} // namespace

template <class T>
void findFirstDensities(DynamicsState<T>& s, base::TaskRunner& tasks)
{
    predict(s, tasks);
    sortParticles(s, tasks);
    predict(s, tasks);
    guessFirstSupports(s, tasks);
    boundSupports(s);
    keepActive(s, [&s](uint32_t i) { return isNew(s, i); });
    // A lone particle grows by a quarter each time until it reaches the bound.
    for (int round = 0; round < 100 && s.activeCount > 0; ++round) {
        searchNeighbors(s, s.activeSlots(), kReach, tasks);
        sumDensities(s, s.activeSlots(), kReach, tasks);
        keepActive(s, [&s](uint32_t i) { return s.wantsReach[i] != 0; });
    }
    for (uint32_t i = 0; i < s.count; ++i)
        if (isNew(s, i))
            s.gas.entropy[i] = T(entropyOf(s.def.state, double(s.gas.density[i]), double(s.gas.energy[i])));
    sortParticles(s, tasks); // the tree measures its slackness from supports, which were not known before
}

template void findFirstDensities<float>(DynamicsState<float>&, base::TaskRunner&);
template void findFirstDensities<double>(DynamicsState<double>&, base::TaskRunner&);

} // namespace fx::sim
