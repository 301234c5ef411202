/// @file hill_colors.h
/// Luminance of the hills of formula wooded-horizon.
#pragma once

#include "rendering/frame/view_types.h"

#include <algorithm>
#include <numbers>

namespace fx::render {

/// [cd/m2]
struct HillColors
{
    glm::vec3 far{0.0f};  ///< distant hills
    glm::vec3 near{0.0f}; ///< trees in front of them
};

/// Leaves under sun and sky, of which air hides a share behind the light of the horizon.
/// @param horizon [cd/m2] luminance of the sky at the horizon
inline HillColors hillColors(const Lighting& lighting, const glm::vec3& horizon)
{
    constexpr glm::vec3 kLeaves(0.062f, 0.07f, 0.05f); // albedo
    constexpr float kFarHaze = 0.55f, kNearHaze = 0.2f;
    const float sun = std::max(lighting.sunDirection.y, 0.0f) * std::numbers::inv_pi_v<float>;
    const glm::vec3 leaves = kLeaves * (lighting.sunIlluminance * sun + lighting.skyLuminance);
    return {leaves + (horizon - leaves) * kFarHaze, leaves + (horizon - leaves) * kNearHaze};
}

} // namespace fx::render
