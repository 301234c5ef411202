/// @file network_passes.h
/// Illumination networks on the GPU: light in fields that is scattered any number of times.
///
/// The network equals ScatteringNetwork with 26 directions and 4 moments. It has three color channels, and a
/// separate phase function in each cell.
#pragma once

#include "rendering/passes/light_bindings.h"

#include <cstdint>

namespace fx::render {

/// number of blocks along x and y in the texture of rays; one block per direction
constexpr int kNetworkRays[2] = {7, 4};
constexpr int kNetworkMoments = 3; ///< number of blocks of moments, and of blocks of sources: one per color
constexpr int kNetworkMedium = 2;  ///< blocks of the medium

/// Three-dimensional textures of blocks of `cells` cubed texels, see shaders/network/network_grid.glsl. All
/// are RGBA32F, except `scatter`.
struct NetworkTextures
{
    ResourceId cells = {};   ///< rgb emitted light [exposed/m]; a extinction [1/m]
    ResourceId scatter = {}; ///< rgb extinction times albedo [1/m]; a mean cosine of the phase function
    ResourceId medium = {};  ///< kNetworkMedium blocks
    /// KNetworkMoments blocks: sources without the light that the network has scattered.
    ResourceId unswept = {};
    /// KNetworkMoments blocks: sources with the light that the network has scattered.
    ResourceId sources = {};
    ResourceId moments = {}; ///< kNetworkMoments blocks: moments of the light; kept from frame to frame
    ResourceId rays = {};    ///< kNetworkRays blocks
};

/// Runs sweeps (iterations) of the networks.
///
/// reads   grids     buffer of FieldGlowBlock: present and previous positions of grids
///         textures  cells and scatter; with `prepares` also the moments of the previous frame
///         lights    all lights
/// writes  textures  medium and unswept with `prepares`; sources, moments, rays
class NetworkPasses
{
public:
    struct Inputs
    {
        ResourceId grids;
        NetworkTextures textures;
        LightBindings lights;
        int cells;          ///< number of cells along a side of a grid, a multiple of 8
        uint32_t gridCount; ///< > 0
        int sweeps;         ///< number of sweeps
        /// True: medium or lights have changed; false: the sweeps start from the present sources.
        bool prepares;
    };
    struct Outputs
    {
        NetworkTextures textures;
    };
    [[nodiscard]] static Outputs addTo(FrameGraph& graph, const Inputs& in);
};

extern const ProgramDesc kNetworkPrepareProgram, kNetworkRaysProgram, kNetworkSumProgram;

} // namespace fx::render
