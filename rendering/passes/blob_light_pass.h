/// @file blob_light_pass.h
/// The pass that computes the parts of the scattered light that vary little within a blob.
#pragma once

#include "rendering/frame/view_block.h"
#include "rendering/frame_graph/frame_graph.h"
#include "rendering/passes/light_bindings.h"

namespace fx::render {

/// @param network true: the program reads illumination networks
const ProgramDesc& blobLightProgram(bool network);
constexpr size_t kBlobLightBytes = 3 * 16; ///< [byte] size of the data of a blob

/// Computes, at four points of each blob, the light of sky, ground and point lights, and the multiply
/// scattered light of the sun.
///
/// Blobs whose center is in the grid of an illumination network get the light of the network instead, and a
/// flag that says so.
///
/// reads   blobs       buffer of BlobInstance
///         lights      all lights of the view
///         networks    illumination networks
/// writes  blobLights  buffer; for each blob: rgb exposed radiance at the center, xyz relative gradient
///                     [1/radius]
class BlobLightPass
{
public:
    /// Illumination networks of a view.
    struct Networks
    {
        ResourceId moments = {}; ///< see NetworkTextures; invalid: no networks
        ResourceId grids = {};   ///< buffer of FieldGlowBlock
        int block = 0;           ///< [texel] size of a block of moments along x
        int gridCount = 0;
    };
    struct Inputs
    {
        ResourceId blobs;
        ResourceId blobLights;
        LightBindings lights;
        const ViewBlock* view; ///< view of the picture
        uint32_t count;
        Networks networks = {};
    };
    struct Outputs
    {
        ResourceId blobLights;
    };
    [[nodiscard]] static Outputs addTo(FrameGraph& graph, const Inputs& in);
};

} // namespace fx::render
