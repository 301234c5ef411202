#include "benchmarks/bench/particles/bench_depth.h"

#include "rendering/frame/view_block.h"
#include "rendering/gl/gl_device.h"
#include "rendering/stage/stage_camera.h"

#include <glm/geometric.hpp>

#include <limits>
#include <vector>

namespace fx::cli {
namespace {

constexpr int kWidth = 1280, kHeight = 720;
const glm::vec3 kNormal = glm::normalize(glm::vec3(-0.5f, 1.0f, 0.0f));
constexpr glm::vec3 kPlace{1.0f, 0.0f, 0.0f}; ///< [m] of the slope

} // namespace

base::Result<BenchDepth> BenchDepth::create(render::GlDevice& device)
{
    BenchDepth made;
    made.camera_ =
        render::perspectiveView({{-3.0, 6.0, 11.0}, {0.0, 1.0, 0.0}}, 1.0f, float(kWidth) / kHeight, 0.1f);
    const render::ViewBlock view = render::makeViewBlock(made.camera_, kWidth, kHeight);
    const glm::vec3 eye(made.camera_.origin);
    std::vector<float> distances;
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
            const float u = 2.0f * (float(x) + 0.5f) / kWidth - 1.0f;
            const float v = 2.0f * (float(y) + 0.5f) / kHeight - 1.0f;
            const glm::vec3 way = glm::normalize(
                glm::vec3(view.rayDirection + u * view.rayDirectionX + v * view.rayDirectionY));
            const float distance = glm::dot(kNormal, kPlace - eye) / glm::dot(kNormal, way);
            distances.push_back(distance > 0.0f ? distance : std::numeric_limits<float>::infinity());
        }
    auto texture = render::GlTexture::create(device, kWidth, kHeight, GL_R32F, "distance of a slope");
    if (!texture)
        return texture.status();
    device.gl.TextureSubImage2D(texture->name(), 0, 0, 0, kWidth, kHeight, GL_RED, GL_FLOAT,
                                distances.data());
    made.distance_ = std::move(*texture);
    return made;
}

render::GpuDepth BenchDepth::in(render::FrameGraph& graph) const
{
    return {
        graph.importTexture({"distance of a slope", kWidth, kHeight, render::Format::R32F}, distance_.name()),
        &camera_, kWidth, kHeight};
}

} // namespace fx::cli
