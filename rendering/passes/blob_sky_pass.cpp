#include "rendering/passes/blob_sky_pass.h"

#include "rendering/passes/media_source.h"

#include <glm/vec4.hpp>

namespace fx::render {

constexpr ProgramDesc kBlobSkyProgram{"blob sky", nullptr, nullptr, "lights/blob_sky.comp.glsl", nullptr};

BlobSkyPass::Outputs BlobSkyPass::addTo(FrameGraph& graph, const Inputs& in)
{
    Outputs out;
    graph.addPass("blob sky", [&](FrameGraph::Builder& builder) {
        builder.read(in.blobs);
        in.lights.read(builder);
        out.skies = builder.write(in.skies);
        return [in, skies = out.skies](Backend& backend) {
            struct
            {
                glm::ivec4 count;
                LightListBlock lights;
            } const uniforms{{int(in.count), 0, 0, 0}, *in.lights.block};
            const TextureBinding textures[] = {in.lights.textureBinding()};
            const BufferBinding buffers[] = {{0, in.blobs}, {kBlobSkyBinding, skies}};
            DispatchCall call;
            call.program = &kBlobSkyProgram;
            call.textures = textures;
            call.buffers = buffers;
            call.uniforms = asUniforms(uniforms);
            call.groups[0] = (in.count + 63) / 64;
            backend.dispatch(call);
        };
    });
    return out;
}

} // namespace fx::render
