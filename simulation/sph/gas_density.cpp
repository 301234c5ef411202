#include "simulation/sph/gas_density.h"

#include "foundation/math/elementary.h"
#include "simulation/sph/neighbor_batch.h"

#include <algorithm>
#include <cmath>

namespace fx::sim {

namespace {

namespace sorted = gas_sorted;

/// Sums over the neighbors of one particle.
struct NumberSums
{
    float number = 0; ///< [1/m3]
    float gx = 0;     ///< [1/m4] gradient of the number density
    float gy = 0;
    float gz = 0;
    uint32_t neighbors = 0;
};

NumberSums sumNumber(const NeighborGrid& grid, GasStore& gas, uint32_t i)
{
    const float* const x = gas.sortedAt(sorted::X);
    const float* const y = gas.sortedAt(sorted::Y);
    const float* const z = gas.sortedAt(sorted::Z);
    const Wendland kernel = gas.kernels[i];
    NumberSums sums;
    forEachNeighborBatch(grid, gas, i, [&](std::span<const uint32_t> neighbors) {
        listNeighbors(gas, i, sums.neighbors, neighbors);
        sums.neighbors += uint32_t(neighbors.size());
        for (const uint32_t j : neighbors) {
            const float dx = x[i] - x[j];
            const float dy = y[i] - y[j];
            const float dz = z[i] - z[j];
            const float r = std::sqrt(dx * dx + dy * dy + dz * dz);
            const float g = kernel.gradient(r);
            sums.number += kernel.value(r); // (1)
            sums.gx += g * dx;              // (2)
            sums.gy += g * dy;
            sums.gz += g * dz;
        }
    });
    return sums;
}

} // namespace

void sumDensity(const NeighborGrid& grid, GasStore& gas, uint32_t begin, uint32_t end)
{
    const float* const smoothing = gas.sortedAt(sorted::Smoothing);
    float* const density = gas.sortedAt(sorted::Density);
    float* const exposure = gas.sortedAt(sorted::Exposure);
    for (uint32_t i = begin; i < end; ++i) {
        const NumberSums sums = sumNumber(grid, gas, i);
        const float h = smoothing[i];
        const float own = kWendlandCenter / (h * h * h);
        const float slope = std::sqrt(sums.gx * sums.gx + sums.gy * sums.gy + sums.gz * sums.gz);
        const float surface = h * slope / (1.2f * sums.number);
        const float lone = (own / sums.number - 0.3f) * 2.0f; // (3)
        density[i] = gas.mass * sums.number;
        exposure[i] = std::clamp(std::max(surface, lone), 0.0f, 1.0f);
        gas.pairs[i] = sums.neighbors - 1;
    }
}

float adaptSmoothing(float smoothing, float mass, float density, float equilibrium)
{
    const float balanced = kNeighborhood * float(base::cubeRoot(double(mass / equilibrium)));
    const float wanted = kNeighborhood * float(base::cubeRoot(double(mass / density))); // (4)
    const float next = std::clamp(wanted, smoothing / 1.26f, smoothing * 1.26f);
    return std::clamp(next, 0.02f * balanced, 1.6f * balanced);
}

} // namespace fx::sim
