/// @file blob_sky_pass.h
/// The pass that finds what light of sky and ground each blob scatters.
#pragma once

#include "rendering/frame_graph/frame_graph.h"
#include "rendering/passes/light_bindings.h"

namespace fx::render {

extern const ProgramDesc kBlobSkyProgram;
constexpr size_t kBlobSkyBytes = 2 * 16; ///< [byte] a blob

/// reads   blobs    buffer of BlobInstance
///         lights   with planes for the axes of the sky
/// writes  skies    buffer, two vec4 a blob: rgb exposed radiance in the middle; xyz its relative slope
/// [1/radius]
class BlobSkyPass
{
public:
    struct Inputs
    {
        ResourceId blobs;
        ResourceId skies;
        LightBindings lights;
        uint32_t count;
    };
    struct Outputs
    {
        ResourceId skies;
    };
    [[nodiscard]] static Outputs addTo(FrameGraph& graph, const Inputs& in);
};

} // namespace fx::render
