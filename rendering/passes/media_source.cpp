#include "rendering/passes/media_source.h"

namespace fx::render {

void drawQuads(Backend& backend, const ProgramDesc& program, ResourceId instances, const DrawBatch& batch,
               const MediaTarget& target, const TextureBinding& picture)
{
    ViewBlock view = *target.view;
    view.pass.y = float(batch.first); // exact up to 2^24
    const TextureBinding textures[] = {{0, target.distance}, picture};
    const BufferBinding buffers[] = {{0, instances}};
    DrawCall call;
    call.program = &program;
    call.targets = target.targets;
    call.textures = {textures, picture.texture.valid() ? 2u : 1u};
    call.buffers = buffers;
    call.uniforms = asUniforms(view);
    call.blend = Blend::Premultiplied;
    call.vertices = 6;
    call.instances = batch.count;
    backend.draw(call);
}

} // namespace fx::render
