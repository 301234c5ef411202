#include "rendering/passes/media_pass.h"

namespace fx::render {

namespace {

constexpr ProgramDesc program(const char* defines)
{
    return {"media", "passes/media.vert.glsl", "passes/media.frag.glsl", nullptr, defines};
}

// index = small * 12 + form * 4 + detail * 2 + layers
constexpr ProgramDesc kPrograms[kMediaPrograms] = {
    program("FX_FORM=0 FX_DETAIL=0 FX_LAYERS=0 FX_SMALL=0"),
    program("FX_FORM=0 FX_DETAIL=0 FX_LAYERS=1 FX_SMALL=0"),
    program("FX_FORM=0 FX_DETAIL=1 FX_LAYERS=0 FX_SMALL=0"),
    program("FX_FORM=0 FX_DETAIL=1 FX_LAYERS=1 FX_SMALL=0"),
    program("FX_FORM=1 FX_DETAIL=0 FX_LAYERS=0 FX_SMALL=0"),
    program("FX_FORM=1 FX_DETAIL=0 FX_LAYERS=1 FX_SMALL=0"),
    program("FX_FORM=1 FX_DETAIL=1 FX_LAYERS=0 FX_SMALL=0"),
    program("FX_FORM=1 FX_DETAIL=1 FX_LAYERS=1 FX_SMALL=0"),
    program("FX_FORM=2 FX_DETAIL=0 FX_LAYERS=0 FX_SMALL=0"),
    program("FX_FORM=2 FX_DETAIL=0 FX_LAYERS=1 FX_SMALL=0"),
    program("FX_FORM=2 FX_DETAIL=1 FX_LAYERS=0 FX_SMALL=0"),
    program("FX_FORM=2 FX_DETAIL=1 FX_LAYERS=1 FX_SMALL=0"),
    program("FX_FORM=0 FX_DETAIL=0 FX_LAYERS=0 FX_SMALL=1"),
    program("FX_FORM=0 FX_DETAIL=0 FX_LAYERS=1 FX_SMALL=1"),
    program("FX_FORM=0 FX_DETAIL=1 FX_LAYERS=0 FX_SMALL=1"),
    program("FX_FORM=0 FX_DETAIL=1 FX_LAYERS=1 FX_SMALL=1"),
    program("FX_FORM=1 FX_DETAIL=0 FX_LAYERS=0 FX_SMALL=1"),
    program("FX_FORM=1 FX_DETAIL=0 FX_LAYERS=1 FX_SMALL=1"),
    program("FX_FORM=1 FX_DETAIL=1 FX_LAYERS=0 FX_SMALL=1"),
    program("FX_FORM=1 FX_DETAIL=1 FX_LAYERS=1 FX_SMALL=1"),
    program("FX_FORM=2 FX_DETAIL=0 FX_LAYERS=0 FX_SMALL=1"),
    program("FX_FORM=2 FX_DETAIL=0 FX_LAYERS=1 FX_SMALL=1"),
    program("FX_FORM=2 FX_DETAIL=1 FX_LAYERS=0 FX_SMALL=1"),
    program("FX_FORM=2 FX_DETAIL=1 FX_LAYERS=1 FX_SMALL=1"),
};

TextureDesc targetDesc(const MediaPass::Inputs& in, size_t target)
{
    constexpr std::string_view kNames[MediaPass::LayerTargets] = {
        "fire light", "smoke light", "dust light", "coverage", "depth moment", "optical depth"};
    const bool scalar = in.layers && (target == MediaPass::DepthMoment || target == MediaPass::OpticalDepth);
    return {in.layers ? kNames[target] : "media", in.width, in.height,
            scalar ? Format::R32F : Format::RGBA32F};
}

} // namespace

const ProgramDesc& mediaProgramAt(size_t index)
{
    return kPrograms[index];
}

const ProgramDesc& mediaProgram(BillboardForm form, bool detail, bool layers, bool isSmall)
{
    return kPrograms[(isSmall ? kMediaPrograms / 2 : 0) + size_t(form) * 4 + (detail ? 2 : 0) +
                     (layers ? 1 : 0)];
}

MediaPass::Outputs MediaPass::addTo(FrameGraph& graph, const Inputs& in)
{
    Outputs out;
    if (in.count == 0)
        return out; // nothing to draw: the graph does not even see this pass

    graph.addPass("media", [&](FrameGraph::Builder& builder) {
        const size_t targetCount = in.layers ? size_t(LayerTargets) : 1;
        std::array<ResourceId, LayerTargets> targets;
        builder.read(in.blobs);
        builder.read(in.distance);
        for (size_t i = 0; i < targetCount; ++i)
            targets[i] = builder.write(builder.create(targetDesc(in, i)));
        if (in.layers)
            out.layers = targets;
        else
            out.media = targets[0];

        return [in, targets, targetCount](Backend& backend) {
            for (size_t i = 0; i < targetCount; ++i)
                backend.clear(targets[i], {0.0f, 0.0f, 0.0f, 0.0f});
            const TextureBinding textures[] = {{0, in.distance}};
            const BufferBinding buffers[] = {{0, in.blobs}};
            DrawCall call;
            call.program = &mediaProgram(in.form, in.detail, in.layers, in.isSmall);
            call.targets = {targets.data(), targetCount};
            call.textures = textures;
            call.buffers = buffers;
            call.uniforms = asUniforms(in.view);
            call.blend = Blend::Premultiplied;
            call.vertices = 6;
            call.instances = in.count;
            backend.draw(call);
        };
    });
    return out;
}

} // namespace fx::render
