#include "rendering/frame/view_block.h"

#include <glm/matrix.hpp>
#include <glm/vec2.hpp>

#include <cmath>
#include <limits>

namespace fx::render {

namespace {

constexpr float kUnlimited = std::numeric_limits<float>::infinity();

/// Distance along the axis of clip depth `n`, from the projection's third and fourth rows.
float axisDistance(const glm::mat4& p, float n)
{
    return -(p[3][2] - n * p[3][3]) / (n * p[2][3] - p[2][2]);
}

} // namespace

CameraGeometry cameraGeometry(const CameraView& camera)
{
    const glm::mat4& p = camera.projection;
    const glm::mat4& v = camera.view;
    CameraGeometry g;
    g.right = {v[0][0], v[1][0], v[2][0]};
    g.up = {v[0][1], v[1][1], v[2][1]};
    g.forward = -glm::vec3(v[0][2], v[1][2], v[2][2]);
    const glm::dvec3 t(v[3][0], v[3][1], v[3][2]);
    const glm::dmat3 rotation(v);
    g.eye = camera.origin - glm::transpose(rotation) * t;
    g.orthographic = std::abs(p[3][3]) > std::abs(p[2][3]);
    const float nearClip =
        camera.depth == DepthConvention::Reversed ? 1.0f : (camera.zeroToOne ? 0.0f : -1.0f);
    g.nearDistance = axisDistance(p, nearClip);
    g.clipScale = {p[0][0], p[1][1]};
    g.clipOffset = g.orthographic ? glm::vec2(p[3][0], p[3][1]) : -glm::vec2(p[2][0], p[2][1]);
    return g;
}

ViewBlock makeViewBlock(const CameraView& camera, int width, int height)
{
    const CameraGeometry g = cameraGeometry(camera);
    const glm::mat4& p = camera.projection;
    const float flip = camera.upperLeftOrigin ? -1.0f : 1.0f;

    // A window position w in [-1, 1]^2 has slope (w - clipOffset) / clipScale in the camera's axes.
    const glm::vec3 center =
        -g.right * (g.clipOffset.x / g.clipScale.x) - g.up * (g.clipOffset.y / g.clipScale.y);
    const glm::vec3 perX = g.right / g.clipScale.x;
    const glm::vec3 perY = g.up * (flip / g.clipScale.y);
    const glm::vec3 none(0.0f);

    ViewBlock b{};
    b.rayOrigin = {g.orthographic ? center : none, g.orthographic ? 1.0f : 0.0f};
    b.rayOriginX = {g.orthographic ? perX : none, g.nearDistance};
    b.rayOriginY = {g.orthographic ? perY : none, flip};
    b.rayDirection = {g.orthographic ? g.forward : g.forward + center, 0.0f};
    b.rayDirectionX = {g.orthographic ? none : perX, float(width)};
    b.rayDirectionY = {g.orthographic ? none : perY, float(height)};
    b.right = {g.right, g.clipScale.x};
    b.up = {g.up, g.clipScale.y};
    b.forward = {g.forward, 1.0f};
    b.clipOffset = {g.clipOffset, -kUnlimited, kUnlimited};
    b.depthScale = {p[3][2], p[3][3], p[2][3], p[2][2]};
    const float farStored = camera.depth == DepthConvention::Reversed ? 0.0f : 1.0f;
    b.depthRange = {camera.zeroToOne ? 1.0f : 2.0f, camera.zeroToOne ? 0.0f : -1.0f, farStored, 0.0f};
    b.sunDirection = {0.0f, 1.0f, 0.0f, 0.5f * float(height) * g.clipScale.y};
    return b;
}

} // namespace fx::render
