#include "rendering/passes/heat_offset_pass.h"

#include "foundation/math/bits.h"

#include <cmath>

namespace fx::render {

float heatPhase(double time)
{
    if (!base::isFinite(time))
        return 0.0f;
    const double remainder = std::fmod(time, kHeatPeriod); // exact
    const float phase = float((remainder < 0.0 ? remainder + kHeatPeriod : remainder) / kHeatPeriod);
    return phase < 1.0f ? phase : 0.0f;
}

HeatOffsetPass::Outputs HeatOffsetPass::addTo(FrameGraph& graph, const Inputs& in)
{
    Outputs out;
    if (in.count == 0 || !in.anyHeat || !(in.settings.strength > 0.0f) || !(in.settings.maxOffset > 0.0f))
        return out;

    graph.addPass("heat offset", [&](FrameGraph::Builder& builder) {
        builder.read(in.blobs);
        builder.read(in.distance);
        out.heat = builder.write(builder.create(TextureDesc{"heat", in.width, in.height, Format::RGBA32F}));
        ViewBlock view = in.view;
        view.pass = {heatPhase(in.time), 0.0f, 0.0f, 0.0f};
        return [blobs = in.blobs, distance = in.distance, count = in.count, view,
                target = out.heat](Backend& backend) {
            backend.clear(target, {0.0f, 0.0f, 0.0f, 0.0f});
            const TextureBinding textures[] = {{0, distance}};
            const BufferBinding buffers[] = {{0, blobs}};
            DrawCall call;
            call.program = &kHeatOffsetProgram;
            call.targets = {&target, 1};
            call.textures = textures;
            call.buffers = buffers;
            call.uniforms = asUniforms(view);
            call.blend = Blend::Additive;
            call.vertices = 6;
            call.instances = count;
            backend.draw(call);
        };
    });
    return out;
}

} // namespace fx::render
