/// @file blob_light_pass.h
/// The pass that computes scattered light of blobs that varies little within a blob.
#pragma once

#include "rendering/frame/view_block.h"
#include "rendering/frame_graph/frame_graph.h"
#include "rendering/passes/light_bindings.h"

namespace fx::render {

extern const ProgramDesc kBlobLightProgram;
constexpr size_t kBlobLightBytes = 3 * 16; ///< [byte] a blob

/// Light of sky, ground and points, and light of the sun that is scattered more than once, at four points of
/// each blob.
///
/// reads   blobs       buffer of BlobInstance
///         lights
/// writes  blobLights  buffer, two vec4 a blob: rgb exposed radiance in the middle; xyz its relative slope
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
