#include "rendering/outputs/output_pass.h"

#include "rendering/passes/output_marks.h"
#include "rendering/passes/particle_batch.h"

#include <algorithm>

namespace fx::render {

namespace {

constexpr uint32_t kBlobMarkBinding = 6;

/// Layout of the uniform block of shaders/outputs/outputs.frag.glsl, where each member is explained.
struct OutputBlock
{
    ViewBlock view;
    glm::vec4 pastRight, pastUp, pastForward, pastClip, pastEye;
};
static_assert(sizeof(OutputBlock) == sizeof(ViewBlock) + 5 * 16);

OutputBlock blockOf(const OutputPass::Inputs& in)
{
    const CameraGeometry now = cameraGeometry(*in.camera);
    const CameraGeometry past = cameraGeometry(in.past.camera);
    OutputBlock block{};
    block.view = in.view;
    block.view.pass.y = in.lists.cards.valid() ? 1.0f : 0.0f;
    block.pastRight = {past.right, past.clipScale.x};
    block.pastUp = {past.up, past.clipScale.y};
    block.pastForward = {past.forward, in.past.camera.upperLeftOrigin ? -1.0f : 1.0f};
    block.pastClip = {past.clipOffset, past.orthographic ? 1.0f : 0.0f, in.past.seconds};
    block.pastEye = {glm::vec3(past.eye - now.eye), in.solids.velocity.valid() ? 1.0f : 0.0f};
    return block;
}

constexpr TextureDesc descOf(size_t output, int width, int height)
{
    constexpr std::string_view kNames[] = {"instance ids", "motion", "first depth", "mean depth",
                                           "optical depth output"};
    constexpr Format kFormats[] = {Format::RG32UI, Format::RG32F, Format::R32F, Format::R32F, Format::R32F};
    return {kNames[output], width, height, kFormats[output]};
}

} // namespace

std::span<const ProgramDesc* const> outputPrograms()
{
    static const auto all = [] {
        constexpr size_t kOwn = 5, kShapes = size_t(BatchShape::Count);
        std::array<const ProgramDesc*, kOwn + 2 * kShapes> list{&kOutputWholeProgram, &kOutputMediaProgram,
                                                                &kSlabCardsProgram, &slabBallsProgram(false),
                                                                &kSlabTilesProgram};
        for (size_t i = 0; i < kShapes; ++i) {
            list[kOwn + i] = &markedCardProgram(BatchShape(i));
            list[kOwn + kShapes + i] = &markedSolidProgram(BatchShape(i));
        }
        return list;
    }();
    return all;
}

void FrameHistory::advance(const FrameRequest& request)
{
    const bool isFirst = !hasFrame_ || request.resetHistory;
    past_.camera = isFirst ? request.camera : camera_;
    past_.seconds = float(std::max(isFirst ? request.deltaTime : request.time - time_, 0.0));
    camera_ = request.camera;
    time_ = request.time;
    hasFrame_ = true;
}

SolidMarks SolidMarkPass::addTo(FrameGraph& graph, const Inputs& in)
{
    SolidMarks out;
    if (in.sources.empty())
        return out;
    graph.addPass("solid marks", [&](FrameGraph::Builder& builder) {
        builder.read(in.distance);
        for (const MediaSource* source : in.sources)
            source->read(builder);
        const auto make = [&](std::string_view name, Format format) {
            return builder.write(builder.create(TextureDesc{name, in.width, in.height, format}));
        };
        out = {make("velocity of solids", Format::RGBA32F), make("instance of solids", Format::RG32UI)};
        const ResourceId depth = make("depth of marks", Format::Depth32F);
        return [in, out, depth](Backend& backend) {
            const ResourceId targets[] = {out.velocity, out.instance};
            for (const ResourceId cleared : {out.velocity, out.instance, depth})
                backend.clear(cleared, {0.0f, 0.0f, 0.0f, 0.0f});
            MediaTarget target{&in.view, in.distance, targets, false, false};
            target.isMarked = true;
            for (const MediaSource* source : in.sources)
                source->drawSolids(backend, target, depth);
        };
    });
    return out;
}

OutputTextures OutputPass::addTo(FrameGraph& graph, const Inputs& in)
{
    OutputTextures out;
    graph.addPass("outputs", [&](FrameGraph::Builder& builder) {
        const SlabMedia::Lists& lists = in.lists;
        for (const ResourceId id : {lists.balls, lists.cards.heads, lists.cards.nodes, lists.cards.marks,
                                    in.marks, in.solids.velocity, in.solids.instance})
            if (id.valid())
                builder.read(id);
        builder.read(lists.tiles.tiles);
        builder.read(lists.tiles.lists);
        builder.read(in.distance);
        for (size_t i = 0; i < out.size(); ++i)
            if ((in.outputs >> i & 1u) != 0)
                out[i] = builder.write(builder.create(descOf(i, in.width, in.height)));
        return [out, lists, solids = in.solids, distance = in.distance, marks = in.marks,
                block = blockOf(in)](Backend& backend) {
            TextureBinding textures[5] = {{0, distance}, {9, lists.tiles.lists}};
            size_t textureCount = 2;
            if (lists.balls.valid())
                textures[textureCount++] = {8, lists.balls};
            if (solids.velocity.valid()) {
                textures[textureCount++] = {1, solids.velocity};
                textures[textureCount++] = {2, solids.instance};
            }
            const auto orTiles = [&](ResourceId id) {
                return id.valid() ? id : lists.tiles.tiles;
            }; // never read
            const BufferBinding buffers[] = {{2, lists.tiles.tiles},
                                             {kCardHeadBinding, orTiles(lists.cards.heads)},
                                             {kCardNodeBinding, orTiles(lists.cards.nodes)},
                                             {kBlobMarkBinding, orTiles(marks)},
                                             {kCardMarkBinding, orTiles(lists.cards.marks)}};
            DrawCall call;
            call.program = &kOutputWholeProgram;
            call.targets = out;
            call.textures = {textures, textureCount};
            call.buffers = buffers;
            call.uniforms = asUniforms(block);
            backend.draw(call);
            call.program = &kOutputMediaProgram;
            call.vertices = 6;
            call.indirect = lists.tiles.tiles;
            backend.draw(call);
        };
    });
    return out;
}

} // namespace fx::render
