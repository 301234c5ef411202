#include "simulation/sph/dynamics/dynamics_state.h"

#include <algorithm>
#include <cmath>

namespace fx::sim {

namespace {

/// Memory for lists: what is within the larger of two supports, a margin, and the padding.
uint32_t listEntries(double neighbors)
{
    return (uint32_t(2.0 * neighbors) + 2 * kLanes - 1) / kLanes * kLanes;
}

template <class T>
DensityRules densityRulesOf(const GasDynamicsDef& def)
{
    DensityRules rules;
    rules.kernel = def.kernel;
    rules.neighbors = def.neighbors;
    rules.smallestSupport = def.smallestSupport;
    rules.largestSupport = std::min(def.largestSupport, largestInDomain(def));
    rules.tolerance = sizeof(T) == sizeof(double) ? 1e-7 : 1e-4;
    return rules;
}

} // namespace

double largestInDomain(const GasDynamicsDef& def)
{
    double largest = kEndless;
    for (int a = 0; a < 3; ++a) {
        const double length = def.domain.high[a] - def.domain.low[a];
        if (def.domain.axes[size_t(a)] != AxisKind::Open && std::isfinite(length))
            largest = std::min(largest, 0.39 * length); // searches reach 1.25 times as far, twice
    }
    return largest;
}

template <class T>
DynamicsState<T>::DynamicsState(const GasDynamicsDef& definition, std::pmr::memory_resource* memory)
    : def(definition),
      densityRules(densityRulesOf<T>(definition)), forceRules{definition.kernel, definition.viscosity.beta,
                                                              definition.viscosity.conductivity},
      gas(memory, def.capacity), slot(memory, def.capacity), delayed(memory), tree(memory, def.capacity),
      lists(memory, def.capacity, listEntries(def.neighbors)), sortedX(memory, def.capacity),
      sortedY(memory, def.capacity), sortedZ(memory, def.capacity), sortedSupport(memory, def.capacity),
      nowX(memory, def.capacity), nowY(memory, def.capacity), nowZ(memory, def.capacity),
      listX(memory, def.capacity), listY(memory, def.capacity), listZ(memory, def.capacity),
      listSupport(memory, def.capacity), records(memory, def.capacity), recordRound(memory, def.capacity),
      active(memory, def.capacity), blockCounts(memory, blockCount(def.capacity)),
      blockEnds(memory, blockCount(def.capacity)), blockSpeeds(memory, blockCount(def.capacity)),
      blockNow(memory, blockCount(def.capacity)), blockChanged(memory, blockCount(def.capacity)),
      wantsReach(memory, def.capacity), wanting(memory, def.capacity), neighbors(memory, def.capacity),
      pairs(memory, def.capacity), heating(memory, def.capacity), signalSpeed(memory, def.capacity),
      fastestNeighbor(memory, def.capacity), levelLimit(memory, def.capacity)
{
    std::fill_n(recordRound.data(), def.capacity, 0u);
    for (base::Column<T>* column : {&listX, &listY, &listZ, &listSupport}) // they are saved, built or not
        std::fill_n(column->data(), def.capacity, T(0));
}

template struct DynamicsState<float>;
template struct DynamicsState<double>;

} // namespace fx::sim
