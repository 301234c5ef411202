#include "rendering/passes/media_source.h"

namespace fx::render {

void drawQuads(Backend& backend, const ProgramDesc& program, const QuadInputs& inputs, const DrawBatch& batch,
               const MediaTarget& target)
{
    ViewBlock view = *target.view;
    view.pass.y = float(batch.first); // exact up to 2^24
    TextureBinding textures[4] = {{0, target.distance}};
    BufferBinding buffers[5] = {{0, inputs.instances}};
    size_t textureCount = 1, bufferCount = 1;
    if (inputs.picture.texture.valid())
        textures[textureCount++] = inputs.picture;
    if (inputs.lights && inputs.lights->lights.valid())
        buffers[bufferCount++] = inputs.lights->bufferBinding();
    if (inputs.lights && inputs.lights->planes.valid())
        textures[textureCount++] = inputs.lights->textureBinding();
    if (inputs.lights && inputs.lights->hostShadow.valid())
        textures[textureCount++] = inputs.lights->hostShadowBinding();
    if (inputs.blobLights.valid())
        buffers[bufferCount++] = {kBlobLightBinding, inputs.blobLights};
    if (target.cards.valid()) {
        buffers[bufferCount++] = {kCardHeadBinding, target.cards.heads};
        buffers[bufferCount++] = {kCardNodeBinding, target.cards.nodes};
    }
    DrawCall call;
    call.program = &program;
    call.targets = target.targets;
    call.textures = {textures, textureCount};
    call.buffers = {buffers, bufferCount};
    call.uniforms = asUniforms(view);
    call.blend = Blend::Premultiplied;
    call.vertices = 6 * batch.count; // one instance, see shared/particle_fetch.glsl
    backend.draw(call);
}

} // namespace fx::render
