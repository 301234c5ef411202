/// @file media_shadow.h
/// Uniforms for the shadow of media on surfaces that the host draws. shaders/shared/media_shadow.glsl uses
/// the uniforms to sample light slices.
#pragma once

#include "rendering/lights/slices/light_list.h"

#include <array>

namespace fx::render {

/// Layout of FxMediaShadow in shaders/shared/media_shadow.glsl, where each member is explained. Without
/// planes, all members are 0, and the transmittance is 1.
struct MediaShadowBlock
{
    /// Number of levels of planes of the sun. Higher levels are finer and nearer to the eye. Other lights
    /// have one level.
    static constexpr size_t kLevels = 3;

    std::array<glm::vec4, kLevels> right{}, up{}, along{}, tiles{};
    glm::vec4 place{0.0f};
};
static_assert(sizeof(MediaShadowBlock) == 13 * 16);

/// Returns the uniforms for the shadow of media in a light.
/// @param light index in the list; 0 is the sun
/// @param eye [m] world position to which the list is relative
/// @param origin [m] world position to which the sampled positions are relative
MediaShadowBlock mediaShadow(const LightList& list, size_t light, const glm::dvec3& eye,
                             const glm::dvec3& origin);

} // namespace fx::render
