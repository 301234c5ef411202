// Media for tests of networks, and the network once more in double precision, from the comment.
#pragma once

#include "rendering/network/scattering_network.h"

#include <cstdint>
#include <vector>

namespace fx::test {

/// Numbers of a network, owned.
struct NetworkCase
{
    render::NetworkGrid grid;
    render::NetworkSettings settings;
    std::vector<float> extinction, albedo, emission, environment;

    render::NetworkMedium medium() const { return {grid, extinction, albedo, emission}; }
    /// Sets medium and environment.
    void give(render::ScatteringNetwork& outNetwork) const;
};

/// An even medium of side 1 with one number for each quantity.
NetworkCase evenCase(const glm::ivec3& cells, float opticalDepth, float albedo,
                     const render::NetworkSettings& settings = {});
/// Anything that is allowed, empty cells and black ones among it.
NetworkCase randomCase(uint64_t seed, const glm::ivec3& cells, double mostAlbedo = 1.0);

/// Moments of the light at rest, by elimination: no iteration, no float.
std::vector<double> solvedExactly(const NetworkCase& c);
/// [1] distance of scattered light from that of `light`, as SweepReport has it.
double scatteredError(const NetworkCase& c, const std::vector<float>& light,
                      const std::vector<double>& exact);

} // namespace fx::test
