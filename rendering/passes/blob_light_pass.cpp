#include "rendering/passes/blob_light_pass.h"

#include "rendering/passes/media_source.h"

#include <glm/vec4.hpp>

namespace fx::render {

namespace {

constexpr ProgramDesc kPrograms[] = {
    {"blob light", nullptr, nullptr, "lights/blob_light.comp.glsl", "FX_NETWORK=0"},
    {"blob light", nullptr, nullptr, "lights/blob_light.comp.glsl", "FX_NETWORK=1"},
};

} // namespace

const ProgramDesc& blobLightProgram(bool network)
{
    return kPrograms[network ? 1 : 0];
}

BlobLightPass::Outputs BlobLightPass::addTo(FrameGraph& graph, const Inputs& in)
{
    struct Uniforms
    {
        glm::ivec4 count;
        glm::vec4 viewAxis;
    };
    Outputs out;
    graph.addPass("blob light", [&](FrameGraph::Builder& builder) {
        builder.read(in.blobs);
        in.lights.read(builder);
        for (const ResourceId id : {in.networks.moments, in.networks.grids})
            if (id.valid())
                builder.read(id);
        out.blobLights = builder.write(in.blobLights);
        const Uniforms uniforms{{int(in.count), in.networks.block, in.networks.gridCount, 0},
                                glm::vec4(glm::vec3(in.view->forward), in.view->rayOrigin.w)};
        return [in, uniforms, blobLights = out.blobLights](Backend& backend) {
            TextureBinding textures[3];
            size_t textureCount = 0;
            if (in.lights.planes.valid())
                textures[textureCount++] = in.lights.textureBinding();
            if (in.lights.hostShadow.valid())
                textures[textureCount++] = in.lights.hostShadowBinding();
            const bool hasNetworks = in.networks.moments.valid();
            if (hasNetworks)
                textures[textureCount++] = {3, in.networks.moments, Sampling::Linear};
            const BufferBinding buffers[] = {{0, in.blobs},
                                             in.lights.bufferBinding(),
                                             {kBlobLightBinding, blobLights},
                                             {3, in.networks.grids}};
            DispatchCall call;
            call.program = &blobLightProgram(hasNetworks);
            call.textures = {textures, textureCount};
            call.buffers = std::span(buffers).first(hasNetworks ? 4 : 3);
            call.uniforms = asUniforms(uniforms);
            call.groups[0] = (in.count + 63) / 64;
            backend.dispatch(call);
        };
    });
    return out;
}

} // namespace fx::render
