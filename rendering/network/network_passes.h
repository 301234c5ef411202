/// @file network_passes.h
/// Illumination networks on the GPU: the light of fields, scattered any number of times.
///
/// The same network as ScatteringNetwork with 26 directions and 4 moments, of three color channels, with a
/// phase function of its own in each cell.
#pragma once

#include "rendering/passes/light_bindings.h"

#include <cstdint>

namespace fx::render {

constexpr int kNetworkRays[2] = {7, 4}; ///< blocks beside each other that hold the light of all directions
constexpr int kNetworkMoments = 3;      ///< blocks of moments, and of sources: one a color
constexpr int kNetworkMedium = 2;       ///< blocks of the medium

/// Volumes of cubes of `cells` a side, see shaders/network/network_grid.glsl. All but `scatter` are RGBA32F.
struct NetworkTextures
{
    ResourceId cells = {};   ///< emitted light [exposed/m], extinction [1/m]
    ResourceId scatter = {}; ///< extinction times albedo [1/m], mean cosine
    ResourceId medium = {};  ///< kNetworkMedium blocks
    ResourceId unswept = {}; ///< kNetworkMoments blocks of sources without light of the network
    ResourceId sources = {}; ///< likewise, with it
    ResourceId moments = {}; ///< likewise, of the light: kept from frame to frame
    ResourceId rays = {};    ///< kNetworkRays blocks
};

/// reads   grids     buffer of FieldGlowBlock: where the grids are, and where they were
///         textures  cells and scatter; with `prepares` the moments of the frame before
///         lights
/// writes  textures  medium and unswept with `prepares`; sources, moments, rays
class NetworkPasses
{
public:
    struct Inputs
    {
        ResourceId grids;
        NetworkTextures textures;
        LightBindings lights;
        int cells;          ///< along a side of a grid, a multiple of 8
        uint32_t gridCount; ///< > 0
        int sweeps;         ///< that are made
        bool prepares;      ///< medium or light have changed; false: goes on with the sources that are there
    };
    struct Outputs
    {
        NetworkTextures textures;
    };
    [[nodiscard]] static Outputs addTo(FrameGraph& graph, const Inputs& in);
};

extern const ProgramDesc kNetworkPrepareProgram, kNetworkRaysProgram, kNetworkSumProgram;

} // namespace fx::render
