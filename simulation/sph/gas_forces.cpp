#include "simulation/sph/gas_forces.h"

#include "foundation/random/philox.h"
#include "simulation/sph/neighbor_batch.h"

#include <algorithm>
#include <cmath>

namespace fx::sim {

namespace {

namespace sorted = gas_sorted;

/// The sorted columns of one loop, so that the loop itself has no lookups.
struct ForceView
{
    explicit ForceView(const GasStore& gas)
        : x(gas.sortedAt(sorted::X)), y(gas.sortedAt(sorted::Y)), z(gas.sortedAt(sorted::Z)),
          vx(gas.sortedAt(sorted::VelocityX)), vy(gas.sortedAt(sorted::VelocityY)),
          vz(gas.sortedAt(sorted::VelocityZ)), h(gas.sortedAt(sorted::Smoothing)),
          sound(gas.sortedAt(sorted::Sound)), density(gas.sortedAt(sorted::Density)),
          push(gas.sortedAt(sorted::Push)), kernel(gas.kernels.data())
    {}
    const float* x;
    const float* y;
    const float* z;
    const float* vx;
    const float* vy;
    const float* vz;
    const float* h;
    const float* sound;
    const float* density;
    const float* push;
    const Wendland* kernel;
};

struct ForceSums
{
    glm::vec3 acceleration{0.0f}; ///< [m/s2] over the particle mass
    float approach = 0;           ///< [m/s]
};

/// A vector of length `size` that is the opposite when a and b change places.
glm::vec3 separation(uint32_t a, uint32_t b, float size)
{
    const std::array<float, 4> u =
        base::randomUnit4(0, std::min(a, b), std::max(a, b), base::RandomPurpose::Gas);
    const glm::vec3 v(u[0] - 0.5f, u[1] - 0.5f, u[2] + 0.5f);
    const float scale = size / std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z);
    return v * (a < b ? scale : -scale);
}

/// Adds what particle j does to particle i (3).
void addPair(const ForceView& p, std::span<const uint32_t> order, float viscosity, uint32_t i, uint32_t j,
             ForceSums& sums)
{
    const float hMean = 0.5f * (p.h[i] + p.h[j]);
    glm::vec3 x(p.x[i] - p.x[j], p.y[i] - p.y[j], p.z[i] - p.z[j]);
    float r2 = x.x * x.x + x.y * x.y + x.z * x.z;
    if (r2 < 1e-12f * hMean * hMean) {
        x = separation(order[i], order[j], 0.05f * hMean);
        r2 = 0.0025f * hMean * hMean;
    }
    const float r = std::sqrt(r2);
    const float gi = p.kernel[i].gradient(r);
    const float gj = p.kernel[j].gradient(r);
    const float vx = (p.vx[i] - p.vx[j]) * x.x + (p.vy[i] - p.vy[j]) * x.y + (p.vz[i] - p.vz[j]) * x.z;
    float strength = p.push[i] * gi + p.push[j] * gj;
    if (vx < 0.0f) {
        const float mu = hMean * vx / (r2 + 0.01f * hMean * hMean);
        const float sound = 0.5f * (p.sound[i] + p.sound[j]);
        const float density = 0.5f * (p.density[i] + p.density[j]);
        const float friction = viscosity * mu * (2.0f * mu - sound) / density; // (4)
        strength += friction * 0.5f * (gi + gj);
        sums.approach = std::max(sums.approach, -mu);
    }
    sums.acceleration -= strength * x;
}

} // namespace

float pressurePush(float density, float equilibrium, float sound)
{
    return sound * sound * std::max(density - equilibrium, 0.0f) / (density * density); // (2)
}

void sumForces(const NeighborGrid& grid, GasStore& gas, float viscosity, uint32_t begin, uint32_t end)
{
    const ForceView p(gas);
    const std::span<const uint32_t> order = grid.order();
    for (uint32_t i = begin; i < end; ++i) {
        ForceSums sums;
        forEachListedBatch(grid, gas, i, [&](std::span<const uint32_t> neighbors) {
            for (const uint32_t j : neighbors)
                if (j != i)
                    addPair(p, order, viscosity, i, j, sums);
        });
        gas.sortedAt(sorted::AccelerationX)[i] = gas.mass * sums.acceleration.x;
        gas.sortedAt(sorted::AccelerationY)[i] = gas.mass * sums.acceleration.y;
        gas.sortedAt(sorted::AccelerationZ)[i] = gas.mass * sums.acceleration.z;
        gas.sortedAt(sorted::Approach)[i] = sums.approach;
    }
}

} // namespace fx::sim
