#include "rendering/passes/impostor_pass.h"

#include <glm/geometric.hpp>

namespace fx::render {

namespace {

constexpr float kSide = float(kTakingColumns * kImpostorTile); ///< [texel] of what is taken at once
constexpr float kDepth = 1024.0f;                              ///< [texel] from the camera to the pictures

} // namespace

CameraView takingCamera(const CameraGeometry& view)
{
    CameraView camera;
    for (int i = 0; i < 3; ++i) {
        camera.view[i][0] = view.right[i];
        camera.view[i][1] = view.up[i];
        camera.view[i][2] = -view.forward[i];
    }
    camera.projection = glm::mat4(1.0f);
    camera.projection[0][0] = camera.projection[1][1] = 2.0f / kSide;
    camera.projection[2][2] = -1.0f / kDepth; // near 0, far twice kDepth
    camera.projection[3][2] = -1.0f;
    return camera;
}

glm::vec3 placeInTaking(const ImpostorTaking& taking, uint32_t slot, const CameraGeometry& view,
                        const glm::vec3& blob, float& outScale)
{
    outScale = 0.5f * float(kImpostorTile) / taking.extent; // [texel/m]
    const glm::vec3 q = (blob - taking.center) * outScale;
    const float half = 0.5f * float(kTakingColumns);
    const float x = (float(slot % uint32_t(kTakingColumns)) + 0.5f - half) * float(kImpostorTile);
    const float y = (float(slot / uint32_t(kTakingColumns)) + 0.5f - half) * float(kImpostorTile);
    return view.right * (x + glm::dot(q, taking.right)) + view.up * (y + glm::dot(q, taking.up)) +
           view.forward * (kDepth + glm::dot(q, taking.forward));
}

ImpostorKeepPass::Outputs ImpostorKeepPass::addTo(FrameGraph& graph, const Inputs& in)
{
    Outputs out;
    graph.addPass("media impostors", [&](FrameGraph::Builder& builder) {
        builder.read(in.taken);
        builder.read(in.tiles);
        out.atlas = builder.write(in.atlas);
        return [in, target = out.atlas](Backend& backend) {
            const TextureBinding textures[] = {{0, in.taken}};
            const BufferBinding buffers[] = {{0, in.tiles}};
            DrawCall call;
            call.program = &kImpostorKeepProgram;
            call.targets = {&target, 1};
            call.textures = textures;
            call.buffers = buffers;
            call.vertices = 6;
            call.instances = in.count;
            backend.draw(call);
        };
    });
    return out;
}

void ImpostorSource::read(FrameGraph::Builder& builder) const
{
    builder.read(instances);
    builder.read(atlas);
}

void ImpostorSource::draw(Backend& backend, const DrawBatch& batch, const MediaTarget& target) const
{
    drawQuads(backend, target.cards.valid() ? kImpostorCardProgram : kImpostorProgram,
              {instances, {1, atlas, Sampling::Linear}}, batch, target);
}

} // namespace fx::render
