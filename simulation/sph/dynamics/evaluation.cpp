#include "simulation/sph/dynamics/evaluation.h"

#include "foundation/math/bits.h"
#include "foundation/tasks/parallel_rows.h"
#include "simulation/sph/dynamics/neighborhood.h"
#include "simulation/sph/dynamics/prediction.h"
#include "simulation/sph/dynamics/step_criteria.h"
#include "simulation/sph/dynamics/viscosity_switch.h"

namespace fx::sim {

namespace {

constexpr uint32_t kPairBatch = 64;  ///< slots of a task in loops over neighbors
constexpr uint32_t kRowBatch = 1024; ///< slots of a task in loops over particles

/// A guess of the support now, from the expansion at the beginning of the step.
template <class T>
void guessSupports(DynamicsState<T>& s, base::TaskRunner& tasks)
{
    parallelRows(tasks, s.activeCount, kRowBatch, [&s](uint32_t begin, uint32_t end) {
        for (uint32_t k = begin; k < end; ++k) {
            const uint32_t i = s.active[k];
            const T since = T(double(s.now - s.gas.begin[i]) * s.tick);
            const T growth = std::min(std::max(since * s.gas.expansion[i] / T(3), T(-0.1)), T(0.1));
            const T most = std::max(T(s.densityRules.largestSupport), s.gas.support[i]);
            s.gas.support[i] = std::min(s.gas.support[i] * (T(1) + growth), most);
        }
    });
}

/// Remembers how much the largest support has grown in this step.
template <class T>
void measureGrowth(DynamicsState<T>& s, base::TaskRunner& tasks)
{
    std::atomic<uint64_t> largest{std::bit_cast<uint64_t>(1.0)};
    parallelRows(tasks, s.activeCount, kRowBatch, [&](uint32_t begin, uint32_t end) {
        T growth = 1;
        for (uint32_t k = begin; k < end; ++k)
            growth = std::max(growth, s.gas.support[s.active[k]] / s.records[s.active[k]].support);
        raiseTo(largest, std::bit_cast<uint64_t>(double(growth))); // bits of positive numbers are in order
    });
    s.listState.growth = (1.0 + s.listState.growth) * std::bit_cast<double>(largest.load()) - 1.0;
}

/// Looks farther around the active slots whose supports have met the end of their lists. Lists of all active
/// slots are searched again: lists of these slots and of their neighbors are too short for the larger
/// supports.
template <class T>
void sumWanting(DynamicsState<T>& s, base::TaskRunner& tasks)
{
    constexpr double kWideReach = 0.25; ///< with what the guess allows, supports grow by a third in a step
    uint32_t count = 0;
    for (const uint32_t i : s.activeSlots())
        if (s.wantsReach[i] != 0)
            s.wanting[count++] = i;
    const std::span<const uint32_t> wanting = s.wanting.first(count);
    searchNeighbors(s, wanting, kWideReach, tasks);
    fillSeen(s, wanting, tasks);
    sumDensities(s, wanting, kWideReach, tasks);
    searchNeighbors(s, s.activeSlots(), marginOfLists(s), tasks);
    fillSeen(s, s.activeSlots(), tasks);
}

/// A density that is a number, whatever the sum has given.
template <class T>
T safeDensity(DynamicsState<T>& s, uint32_t i)
{
    const T density = s.gas.density[i];
    if (base::isFinite(density) && density > 0)
        return density;
    s.clamped.fetch_add(1, std::memory_order_relaxed);
    return s.records[i].density;
}

/// The switch at the end of a step of `seconds`; 0 for a particle without a past.
template <class T>
void updateSwitch(DynamicsState<T>& s, uint32_t i, T seconds)
{
    GasColumns<T>& gas = s.gas;
    const ViscosityRules& def = s.def.viscosity;
    const SwitchRules<T> rules{T(def.alphaMin), T(def.alphaMax), T(def.decay)};
    const T growth = seconds > 0 ? (gas.divergence[i] - gas.divergenceBefore[i]) / seconds : T(0);
    const FlowGradient<T> flow{gas.divergence[i], growth, gas.curl[i], T(0.5) * gas.support[i], gas.sound[i]};
    if (gas.viscosity[i] < 0)
        gas.viscosity[i] = firstViscosity(rules, flow);
    else if (seconds > 0)
        gas.viscosity[i] = switchedViscosity(rules, flow, gas.viscosity[i], seconds);
    gas.divergenceBefore[i] = gas.divergence[i];
    gas.limiter[i] = def.limiter ? shearLimiter(flow) : T(1);
}

template <class T>
void updateState(DynamicsState<T>& s, uint32_t i)
{
    GasColumns<T>& gas = s.gas;
    const T kicked = T(ticksSinceMiddle(s.now, gas.begin[i], gas.end[i]) * s.tick);
    const T entropy = std::max(gas.entropy[i] + kicked * gas.entropyRate[i], T(0.1) * gas.entropy[i]);
    const T density = safeDensity(s, i);
    const StatePoint point = stateAt(s.def.state, density, entropy);
    const T values[4] = {T(point.pressure), T(point.thermal), T(point.sound), T(point.heatToEntropy)};
    gas.density[i] = density;
    if (base::allFinite(values, 4)) {
        gas.pressure[i] = values[0];
        gas.energy[i] = values[1];
        gas.sound[i] = values[2];
        gas.heatToEntropy[i] = values[3];
    } else {
        s.clamped.fetch_add(1, std::memory_order_relaxed);
    }
    updateSwitch(s, i, T(double(s.now - gas.begin[i]) * s.tick));

    GasRecord<T>& record = s.records[i];
    record.support = gas.support[i];
    record.density = density;
    record.pressure = gas.pressure[i];
    record.energy = gas.energy[i];
    record.sound = T(s.soundScale) * gas.sound[i];
    record.push = pushOf(s, gas.correction[i], gas.pressure[i], density);
    record.viscosity = gas.viscosity[i];
    record.limiter = gas.limiter[i];
}

/// Makes rates and the longest step out of the sums over pairs.
template <class T>
void updateRates(DynamicsState<T>& s, uint32_t i)
{
    GasColumns<T>& gas = s.gas;
    const T sums[5] = {gas.ax[i], gas.ay[i], gas.az[i], s.heating[i], s.signalSpeed[i]};
    if (!base::allFinite(sums, 5)) {
        s.clamped.fetch_add(1, std::memory_order_relaxed);
        gas.ax[i] = gas.ay[i] = gas.az[i] = s.heating[i] = 0;
        s.signalSpeed[i] = T(2) * s.records[i].sound;
    }
    gas.ax[i] += T(s.def.gravity.x);
    gas.ay[i] += T(s.def.gravity.y);
    gas.az[i] += T(s.def.gravity.z);
    const T heating = s.heating[i];
    const T density = gas.density[i];
    gas.entropyRate[i] = gas.heatToEntropy[i] * heating;
    gas.pressureRate[i] =
        density * (T(s.def.state.gamma - 1.0) * heating - gas.sound[i] * gas.sound[i] * gas.expansion[i]);
    gas.energyRate[i] = heating - T(s.def.state.gamma - 1.0) * gas.energy[i] * gas.expansion[i];
    const T square = gas.ax[i] * gas.ax[i] + gas.ay[i] * gas.ay[i] + gas.az[i] * gas.az[i];
    T signal = s.signalSpeed[i];
    if (s.def.steps == StepScheme::Block && s.def.exact) // as fast as for the faster one of the pair
        signal = std::max(signal, T(2) * (signal - s.records[i].sound));
    gas.wantedStep[i] = longestStep(
        StepLimits<T>{T(s.def.courant), T(s.def.volumeChange)},
        StepMotion<T>{gas.support[i], signal, square, gas.entropy[i], gas.entropyRate[i], gas.divergence[i]});
    if (s.heatedNow)
        gas.wantedStep[i] *= T(kFirstSteps);
}

} // namespace

template <class T>
bool sumDensities(DynamicsState<T>& s, std::span<const uint32_t> slots, double reach, base::TaskRunner& tasks)
{
    GasColumns<T>& gas = s.gas;
    const DensityResults<T> results{gas.support.data(),    gas.density.data(),  gas.correction.data(),
                                    gas.divergence.data(), gas.curl.data(),     s.wantsReach.data(),
                                    s.neighbors.data(),    gas.exposure.data(), gas.expansion.data()};
    std::atomic<uint32_t> wanting{0};
    parallelRows(tasks, uint32_t(slots.size()), kPairBatch, [&](uint32_t begin, uint32_t end) {
        const std::span<const uint32_t> part = slots.subspan(begin, end - begin);
        sumDensity<T>({s.densityRules, s.pairsOf(part), T(reach), results});
        uint32_t more = 0;
        for (const uint32_t i : part)
            more += s.wantsReach[i];
        wanting.fetch_add(more, std::memory_order_relaxed);
    });
    return wanting.load() > 0;
}

template <class T>
void evaluateDensity(DynamicsState<T>& s, base::TaskRunner& tasks)
{
    double reach = roomOfLists(s);
    if (reach <= 0) {
        guessSupports(s, tasks);
        reach = marginOfLists(s);
        searchNeighbors(s, s.activeSlots(), reach, tasks);
    }
    fillSeen(s, s.activeSlots(), tasks);
    if (sumDensities(s, s.activeSlots(), reach, tasks) && s.def.exact)
        sumWanting(s, tasks);
    else
        measureGrowth(s, tasks);
    s.listsServeActive = true;
}

template <class T>
void evaluateState(DynamicsState<T>& s, base::TaskRunner& tasks)
{
    parallelRows(tasks, s.activeCount, kRowBatch, [&s](uint32_t begin, uint32_t end) {
        for (uint32_t k = begin; k < end; ++k)
            updateState(s, s.active[k]);
    });
}

template <class T>
void evaluateForces(DynamicsState<T>& s, base::TaskRunner& tasks)
{
    const ForceResults<T> results{s.gas.ax.data(),  s.gas.ay.data(),      s.gas.az.data(),
                                  s.heating.data(), s.signalSpeed.data(), s.fastestNeighbor.data(),
                                  s.pairs.data()};
    std::atomic<uint64_t> pairs{0};
    parallelRows(tasks, s.activeCount, kPairBatch, [&](uint32_t begin, uint32_t end) {
        const std::span<const uint32_t> part = s.activeSlots().subspan(begin, end - begin);
        sumForces<T>({s.forceRules, s.pairsOf(part), results});
        uint64_t sum = 0;
        for (const uint32_t i : part) {
            updateRates(s, i);
            sum += s.pairs[i];
        }
        pairs.fetch_add(sum, std::memory_order_relaxed);
    });
    s.pairSum += pairs.load();
}

#define FX_INSTANTIATE(T)                                                                                    \
    template bool sumDensities<T>(DynamicsState<T>&, std::span<const uint32_t>, double, base::TaskRunner&);  \
    template void evaluateDensity<T>(DynamicsState<T>&, base::TaskRunner&);                                  \
    template void evaluateState<T>(DynamicsState<T>&, base::TaskRunner&);                                    \
    template void evaluateForces<T>(DynamicsState<T>&, base::TaskRunner&);
FX_INSTANTIATE(float)
FX_INSTANTIATE(double)
#undef FX_INSTANTIATE

} // namespace fx::sim
