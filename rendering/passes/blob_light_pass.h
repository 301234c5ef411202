/// @file blob_light_pass.h
/// The pass that computes the parts of the scattered light that vary little within a blob.
#pragma once

#include "rendering/frame/view_block.h"
#include "rendering/frame_graph/frame_graph.h"
#include "rendering/passes/light_bindings.h"

namespace fx::render {

extern const ProgramDesc kBlobLightProgram;
constexpr size_t kBlobLightBytes = 3 * 16; ///< [byte] size of the data of a blob

/// Computes, at four points of each blob, the light of sky, ground and point lights, and the multiply
/// scattered light of the sun.
///
/// reads   blobs       buffer of BlobInstance
///         lights      all lights of the view
/// writes  blobLights  buffer; for each blob: rgb exposed radiance at the center, xyz relative gradient
///                     [1/radius]
class BlobLightPass
{
public:
    struct Inputs
    {
        ResourceId blobs;
        ResourceId blobLights;
        LightBindings lights;
        const ViewBlock* view; ///< view of the picture
        uint32_t count;
    };
    struct Outputs
    {
        ResourceId blobLights;
    };
    [[nodiscard]] static Outputs addTo(FrameGraph& graph, const Inputs& in);
};

} // namespace fx::render
