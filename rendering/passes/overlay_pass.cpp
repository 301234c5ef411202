#include "rendering/passes/overlay_pass.h"

#include <bit>

namespace fx::render {

namespace {

constexpr float kLineWidth = 1.5f; ///< [pixel]

/// Layout of OverlayBlock in shaders/frame/overlay.vert.glsl.
struct OverlayBlock
{
    glm::mat4 toClip;
    glm::vec4 line; ///< x, y: half a line's width in clip space
};
static_assert(sizeof(OverlayBlock) == 80);

constexpr uint32_t kEdgeVertices = 12 * 6; ///< two triangles for each edge of a box

} // namespace

OverlayPass::Outputs OverlayPass::addTo(FrameGraph& graph, const Inputs& in)
{
    if (in.boxes.empty())
        return {in.picture};
    Outputs out;
    graph.addPass("activation overlay", [&](FrameGraph::Builder& builder) {
        out.picture = builder.write(in.picture);
        const size_t bytes =
            std::bit_ceil(in.boxes.size_bytes()); // few sizes, so that the pool can reuse them
        const ResourceId buffer = builder.write(builder.create(BufferDesc{"overlay boxes", bytes}));
        const OverlayBlock block{in.camera->projection * in.camera->view,
                                 {kLineWidth / float(in.width), kLineWidth / float(in.height), 0.0f, 0.0f}};
        return [boxes = in.boxes, buffer, block, target = out.picture](Backend& backend) {
            backend.upload(buffer, std::as_bytes(boxes));
            const BufferBinding buffers[] = {{0, buffer}};
            DrawCall call;
            call.program = &kOverlayProgram;
            call.targets = {&target, 1};
            call.buffers = buffers;
            call.uniforms = asUniforms(block);
            call.blend = Blend::Premultiplied;
            call.vertices = kEdgeVertices;
            call.instances = uint32_t(boxes.size());
            backend.draw(call);
        };
    });
    return out;
}

} // namespace fx::render
