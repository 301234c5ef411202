/// @file media_shadow.h
/// The shadow that media cast on surfaces which no view draws: the numbers with which
/// shaders/shared/media_shadow.glsl looks planes up.
#pragma once

#include "rendering/lights/slices/light_list.h"

#include <array>

namespace fx::render {

/// Layout of FxMediaShadow in shaders/shared/media_shadow.glsl, where each member is explained. Without
/// planes all members are 0 and the transmittance is 1.
struct MediaShadowBlock
{
    static constexpr size_t kLevels = 3; ///< of the sun, finer ones near the eye; other lights have one

    std::array<glm::vec4, kLevels> right{}, up{}, along{}, tiles{};
    glm::vec4 place{0.0f};
};
static_assert(sizeof(MediaShadowBlock) == 13 * 16);

/// @param light entry of the list, 0 is the sun  @param eye [m] world position that the list is relative to
/// @param origin [m] world position that the places of lookups are relative to
MediaShadowBlock mediaShadow(const LightList& list, size_t light, const glm::dvec3& eye,
                             const glm::dvec3& origin);

} // namespace fx::render
