/// @file neighbor_batch.h
/// The neighbors of one particle, picked out of the candidates first, so that the work on them has no misses.
#pragma once

#include "simulation/sph/gas_store.h"
#include "simulation/sph/neighbor_grid.h"
#include "simulation/sph/wendland.h"

#include <algorithm>
#include <cstdint>
#include <span>

namespace fx::sim {

/// Calls f(neighbors) with the sorted places within max(h_i, h_j) * support of place `i`, itself included, in
/// ascending order; in several calls when there are very many.
template <class F>
void forEachNeighborBatch(const NeighborGrid& grid, const GasStore& gas, uint32_t i, F&& f)
{
    constexpr uint32_t kBatch = 256;
    const float* const x = gas.sortedAt(gas_sorted::X);
    const float* const y = gas.sortedAt(gas_sorted::Y);
    const float* const z = gas.sortedAt(gas_sorted::Z);
    const float* const h = gas.sortedAt(gas_sorted::Smoothing);
    uint32_t batch[kBatch];
    uint32_t found = 0;
    grid.forEachRun({x[i], y[i], z[i]}, [&](uint32_t first, uint32_t last) {
        for (uint32_t j = first; j < last; ++j) {
            const float dx = x[i] - x[j];
            const float dy = y[i] - y[j];
            const float dz = z[i] - z[j];
            const float reach = kWendlandSupport * std::max(h[i], h[j]);
            batch[found] = j;
            found += dx * dx + dy * dy + dz * dz < reach * reach ? 1u : 0u;
            if (found == kBatch) {
                f(std::span<const uint32_t>(batch, found));
                found = 0;
            }
        }
    });
    f(std::span<const uint32_t>(batch, found));
}

/// The same, from the list that the loop before has made (listNeighbors) where it is complete.
template <class F>
void forEachListedBatch(const NeighborGrid& grid, const GasStore& gas, uint32_t i, F&& f)
{
    const uint32_t count = gas.pairs[i] + 1;
    if (count <= kMostListed)
        f(std::span<const uint32_t>(gas.listed.data() + size_t(i) * kMostListed, count));
    else
        forEachNeighborBatch(grid, gas, i, f);
}

/// Remembers a batch of neighbors of place `i`, of which `before` came earlier, as far as there is room.
inline void listNeighbors(GasStore& gas, uint32_t i, uint32_t before, std::span<const uint32_t> neighbors)
{
    if (before + neighbors.size() <= kMostListed)
        std::copy(neighbors.begin(), neighbors.end(), gas.listed.data() + size_t(i) * kMostListed + before);
}

} // namespace fx::sim
