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

} // namespace

TextureDesc mediaTargetDesc(bool layers, size_t target, int width, int height)
{
    constexpr std::string_view kNames[MediaPass::LayerTargets] = {
        "fire light", "smoke light", "dust light", "coverage", "depth moment", "optical depth"};
    const bool scalar = layers && (target == MediaPass::DepthMoment || target == MediaPass::OpticalDepth);
    return {layers ? kNames[target] : "media", width, height, scalar ? Format::R32F : Format::RGBA32F};
}

const ProgramDesc& mediaProgramAt(size_t index)
{
    return kPrograms[index];
}

const ProgramDesc& mediaProgram(BillboardForm form, bool detail, bool layers, bool isSmall)
{
    return kPrograms[(isSmall ? kMediaPrograms / 2 : 0) + size_t(form) * 4 + (detail ? 2 : 0) +
                     (layers ? 1 : 0)];
}

namespace {

void drawBlobs(Backend& backend, const MediaPass::Inputs& in, const MediaRun& run,
               std::span<const ResourceId> targets)
{
    ViewBlock view = in.view;
    view.pass.y = float(run.first); // exact up to 2^24
    const TextureBinding textures[] = {{0, in.distance}};
    const BufferBinding buffers[] = {{0, in.blobs}};
    DrawCall call;
    call.program = &mediaProgram(in.form, in.detail, in.layers, in.isSmall);
    call.targets = targets;
    call.textures = textures;
    call.buffers = buffers;
    call.uniforms = asUniforms(view);
    call.blend = Blend::Premultiplied;
    call.vertices = 6;
    call.instances = run.count;
    backend.draw(call);
}

} // namespace

MediaPass::Outputs MediaPass::addTo(FrameGraph& graph, const Inputs& in, const Outputs& under)
{
    Outputs out = under;
    if (in.runs.empty())
        return out; // nothing to draw: the graph does not even see this pass

    graph.addPass("media", [&](FrameGraph::Builder& builder) {
        const size_t targetCount = in.layers ? size_t(LayerTargets) : 1;
        const bool isFirst = !(in.layers ? under.layers[0] : under.media).valid();
        std::array<ResourceId, LayerTargets> targets;
        if (in.blobs.valid())
            builder.read(in.blobs);
        readBatches(builder, in.batches);
        if (in.impostors.instances.valid()) {
            builder.read(in.impostors.instances);
            builder.read(in.impostors.atlas);
        }
        builder.read(in.distance);
        for (size_t i = 0; i < targetCount; ++i) {
            const ResourceId before = in.layers ? under.layers[i] : under.media;
            targets[i] = builder.write(
                isFirst ? builder.create(mediaTargetDesc(in.layers, i, in.width, in.height)) : before);
        }
        if (in.layers)
            out.layers = targets;
        else
            out.media = targets[0];

        return [in, targets, targetCount, isFirst](Backend& backend) {
            for (size_t i = 0; isFirst && i < targetCount; ++i)
                backend.clear(targets[i], {0.0f, 0.0f, 0.0f, 0.0f});
            for (const MediaRun& run : in.runs) {
                if (run.batch == MediaRun::kBlobs)
                    drawBlobs(backend, in, run, {targets.data(), targetCount});
                else if (run.batch == MediaRun::kImpostors)
                    drawImpostors(backend, in.impostors, run.first, run.count, in.view, in.distance,
                                  {targets.data(), targetCount});
                else
                    drawBatch(backend, in.batches[run.batch], run.first, run.count, in.view, in.layers,
                              in.distance, {targets.data(), targetCount});
            }
        };
    });
    return out;
}

} // namespace fx::render
