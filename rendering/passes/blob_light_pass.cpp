#include "rendering/passes/blob_light_pass.h"

#include "rendering/passes/media_source.h"

#include <glm/vec4.hpp>

namespace fx::render {

constexpr ProgramDesc kBlobLightProgram{"blob light", nullptr, nullptr, "lights/blob_light.comp.glsl",
                                        nullptr};

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
        out.blobLights = builder.write(in.blobLights);
        const Uniforms uniforms{{int(in.count), 0, 0, 0},
                                glm::vec4(glm::vec3(in.view->forward), in.view->rayOrigin.w)};
        return [in, uniforms, blobLights = out.blobLights](Backend& backend) {
            TextureBinding textures[2];
            size_t textureCount = 0;
            if (in.lights.planes.valid())
                textures[textureCount++] = in.lights.textureBinding();
            if (in.lights.hostShadow.valid())
                textures[textureCount++] = in.lights.hostShadowBinding();
            const BufferBinding buffers[] = {
                {0, in.blobs}, in.lights.bufferBinding(), {kBlobLightBinding, blobLights}};
            DispatchCall call;
            call.program = &kBlobLightProgram;
            call.textures = {textures, textureCount};
            call.buffers = buffers;
            call.uniforms = asUniforms(uniforms);
            call.groups[0] = (in.count + 63) / 64;
            backend.dispatch(call);
        };
    });
    return out;
}

} // namespace fx::render
