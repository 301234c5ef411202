#include "rendering/gpu_particles/gpu_depth.h"

#include "rendering/frame/view_block.h"

#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <cmath>

namespace fx::render {

namespace {

/// Component along a camera's axis of a local place, relative to the eye.
glm::vec4 rowOf(const glm::vec3& axis, const base::Placement& place, const glm::dvec3& eye)
{
    const glm::vec3 turned = glm::conjugate(place.rotation) * axis * place.scale;
    return {turned, float(glm::dot(glm::dvec3(axis), place.position - eye))};
}

/// What a step of 2^-24 of a stored depth, or of the floats after it, is along the axis.
glm::vec4 errorOf(const glm::mat4& p, bool zeroToOne)
{
    const float step = (zeroToOne ? 1.0f : 2.0f) * 0x1p-24f; // of the clip depth
    if (p[3][3] != 0.0f)
        return {step / std::abs(p[2][2]), 0x1p-22f, 0.0f, 0.0f};
    return {0.0f, 0x1p-22f, step * std::abs(p[2][3] / p[3][2]), 0.0f};
}

} // namespace

GpuDepthBlock makeGpuDepthBlock(const GpuDepth& depth, const base::Placement& place)
{
    GpuDepthBlock block{};
    if (!depth.distance.valid() || !depth.camera)
        return block;
    const CameraGeometry camera = cameraGeometry(*depth.camera);
    const float flip = depth.camera->upperLeftOrigin ? -1.0f : 1.0f;
    const auto width = float(depth.width), height = float(depth.height);
    block.right = rowOf(camera.right, place, camera.eye);
    block.up = rowOf(camera.up, place, camera.eye);
    block.forward = rowOf(camera.forward, place, camera.eye);
    block.window = {0.5f * width * camera.clipScale.x, 0.5f * height * flip * camera.clipScale.y,
                    0.5f * width * (1.0f + camera.clipOffset.x),
                    0.5f * height * (1.0f + flip * camera.clipOffset.y)};
    block.error = errorOf(depth.camera->projection, depth.camera->zeroToOne);
    block.size = {width, height, camera.orthographic ? 1.0f : 0.0f, place.scale};
    return block;
}

bool meetsDepth(const base::GpuParticleFeatures& features)
{
    return std::any_of(features.modules.begin(), features.modules.end(),
                       [](const base::GpuModuleUse& use) { return use.module == base::GpuModule::Depth; });
}

} // namespace fx::render
