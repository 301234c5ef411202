/// @file network_passes.h
/// Illumination networks on the GPU. They compute multiple scattering of light in fields.
///
/// The method equals ScatteringNetwork with 26 directions and 4 moments. In addition, the GPU network has
/// three color channels, and a separate phase function in each cell.
#pragma once

#include "rendering/field/field_blocks.h"
#include "rendering/passes/light_bindings.h"

#include <cstdint>
#include <span>

namespace fx::render {

/// number of blocks along x and y in NetworkTextures::rays; each direction has one block
constexpr int kNetworkRays[2] = {7, 4};
constexpr int kNetworkMoments = 3; ///< number of blocks of moments, and of blocks of sources: one per color
constexpr int kNetworkMedium = 2;  ///< number of blocks of the medium

/// Three-dimensional textures of blocks, see shaders/network/network_grid.glsl. All are RGBA32F, except
/// `scatter`.
struct NetworkTextures
{
    ResourceId cells = {};   ///< rgb: emitted light [exposed/m]; alpha: extinction [1/m]
    ResourceId scatter = {}; ///< rgb: extinction times albedo [1/m]; alpha: mean cosine of the phase function
    ResourceId medium = {};  ///< properties of the medium, in kNetworkMedium blocks
    /// Sources without the light that the network has scattered; has kNetworkMoments blocks.
    ResourceId unswept = {};
    /// Sources with the light that the network has scattered; has kNetworkMoments blocks.
    ResourceId sources = {};
    ResourceId moments = {}; ///< kNetworkMoments blocks: moments of the light; kept from frame to frame
    /// Moments of the light of the previous frame, whose blocks may have another size. May be `moments`.
    ResourceId before = {};
    ResourceId rays = {}; ///< kNetworkRays blocks
};

/// Runs sweeps (iterations) of the networks of all grids.
///
/// reads   grids     buffer of FieldGlowBlock: present and previous positions of grids
///         textures  cells and scatter; with `prepares` also `before`
///         lights    all lights
/// writes  textures sources, moments, rays; with `prepares` also medium, unswept
class NetworkPasses
{
public:
    struct Inputs
    {
        ResourceId grids;
        NetworkTextures textures;
        LightBindings lights;
        glm::ivec3 block;   ///< [texel] size of a block
        glm::ivec3 extent;  ///< glowExtent() of the grids; no larger than a block
        uint32_t mostLines; ///< mostNetworkLines() of the grids
        uint32_t gridCount; ///< > 0
        int sweeps;         ///< number of sweeps
        /// True: medium or lights have changed. False: the sweeps continue with the present sources.
        bool prepares;
    };
    struct Outputs
    {
        NetworkTextures textures;
    };
    [[nodiscard]] static Outputs addTo(FrameGraph& graph, const Inputs& in);
};

/// Largest number of lines of one direction that a grid has: one for each cell of three of its faces.
uint32_t mostNetworkLines(std::span<const FieldGlowBlock> grids);

extern const ProgramDesc kNetworkPrepareProgram, kNetworkRaysProgram, kNetworkSumProgram;

} // namespace fx::render
