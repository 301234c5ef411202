// Media for tests of networks, and a reference implementation of the network in double precision.
#pragma once

#include "rendering/network/scattering_network.h"

#include <cstdint>
#include <vector>

namespace fx::test {

/// Medium, light and settings of a network, with their memory.
struct NetworkCase
{
    render::NetworkGrid grid;
    render::NetworkSettings settings;
    std::vector<float> extinction, albedo, emission, environment;

    render::NetworkMedium medium() const { return {grid, extinction, albedo, emission}; }
    /// Sets medium and environment.
    void give(render::ScatteringNetwork& outNetwork) const;
};

/// A homogeneous medium in a box whose side along x is 1.
NetworkCase evenCase(const glm::ivec3& cells, float opticalDepth, float albedo,
                     const render::NetworkSettings& settings = {});
/// A random medium with any allowed values, including empty and black cells.
NetworkCase randomCase(uint64_t seed, const glm::ivec3& cells, double mostAlbedo = 1.0);

/// Moments of the stationary light, solved by elimination in double precision.
std::vector<double> solvedExactly(const NetworkCase& c);
/// [1] Difference between the exact scattered light and the scattered light of `light`, in the norm of
/// SweepReport.
double scatteredError(const NetworkCase& c, const std::vector<float>& light,
                      const std::vector<double>& exact);

} // namespace fx::test
