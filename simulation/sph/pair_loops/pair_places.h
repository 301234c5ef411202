/// @file pair_places.h
/// Whose sums a loop over pairs makes, and over whom.
#pragma once

#include "simulation/sph/neighbors/neighbor_lists.h"
#include "simulation/sph/pair_loops/gas_record.h"

#include <span>

namespace fx::sim {

template <class T>
struct PairPlaces
{
    const NeighborLists<T>& lists;
    const GasRecord<T>* records; ///< by place
    const Domain& domain;
    std::span<const uint32_t> places; ///< a part of the lists' owners
};

} // namespace fx::sim
