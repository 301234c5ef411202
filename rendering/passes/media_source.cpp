#include "rendering/passes/media_source.h"

namespace fx::render {

void drawQuads(Backend& backend, const ProgramDesc& program, const QuadInputs& inputs, const DrawBatch& batch,
               const MediaTarget& target)
{
    struct
    {
        ViewBlock view;
        LightListBlock lights;
    } uniforms;
    uniforms.view = *target.view;
    uniforms.view.pass.y = float(batch.first); // exact up to 2^24
    const bool isLit = inputs.lights && inputs.lights->block;
    if (isLit)
        uniforms.lights = *inputs.lights->block;
    TextureBinding textures[3] = {{0, target.distance}};
    BufferBinding buffers[2] = {{0, inputs.instances}};
    size_t textureCount = 1, bufferCount = 1;
    if (inputs.picture.texture.valid())
        textures[textureCount++] = inputs.picture;
    if (inputs.lights && inputs.lights->planes.valid())
        textures[textureCount++] = inputs.lights->textureBinding();
    if (inputs.skies.valid())
        buffers[bufferCount++] = {kBlobSkyBinding, inputs.skies};
    DrawCall call;
    call.program = &program;
    call.targets = target.targets;
    call.textures = {textures, textureCount};
    call.buffers = {buffers, bufferCount};
    call.uniforms = isLit ? asUniforms(uniforms) : asUniforms(uniforms.view);
    call.blend = Blend::Premultiplied;
    call.vertices = 6;
    call.instances = batch.count;
    backend.draw(call);
}

} // namespace fx::render
