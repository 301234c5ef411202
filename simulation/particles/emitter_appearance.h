/// @file emitter_appearance.h
/// Appearance of the particles of an emitter that are not a medium.
#pragma once

#include "foundation/math/curve.h"
#include "foundation/snapshot/particle_kind.h"

#include <glm/vec3.hpp>

namespace fx::sim {

enum class AppearanceKind : uint8_t
{
    Medium, ///< balls of participating medium, published as the kind "blob"
    Sprite, ///< sprites, published as the kind "particle"
    Mesh,   ///< instanced meshes, published as the kind "particle"
    None,   ///< particles are not published; they only cause births of other particles
};

/// Selection of the frame of a flipbook texture.
enum class FrameClock : uint8_t
{
    None,      ///< constant frame, drawn at random from the range `firstFrame`
    OverLife,  ///< all frames in order, once between birth and death
    PerSecond, ///< `framesPerSecond` frames per second, repeated from the first frame
};

struct EmitterAppearance
{
    AppearanceKind kind = AppearanceKind::Medium;

    // Constants of the group, see base::particle_constant.
    base::ParticleBlend blend = base::ParticleBlend::Alpha;
    base::ParticleOrder order = base::ParticleOrder::Depth;
    float orderBias = 0.0f; ///< [m]
    base::SpriteAlignment alignment = base::SpriteAlignment::Camera;
    glm::vec3 axis{0.0f, 1.0f, 0.0f}; ///< [1] unit vector
    float aspect = 1.0f;              ///< [1] > 0
    float stretch = 0.0f;             ///< [s]
    float luminance = 0.0f;           ///< [cd/m2]
    float lit = 1.0f;                 ///< [1] 0..1
    float softness = 0.0f;            ///< [m]
    uint32_t texture = 0;             ///< id of the texture in the AssetTable; 0: none
    uint32_t tileColumns = 1;
    uint32_t tileRows = 1;
    bool frameBlend = false;
    uint32_t motion = 0;      ///< id of the motion vectors in the AssetTable; 0: none
    float motionScale = 0.0f; ///< [1]
    uint32_t mesh = 0;        ///< id of the mesh in the AssetTable; 0: none
    float meshReach = 1.0f;   ///< [1] distance of the farthest vertex from the origin, in units of the radius

    base::ColorCurve colorOverLife{std::array{1.0f, 1.0f, 1.0f}}; ///< linear Rec. 709
    /// [1] opacity at birth, 0..1; multiplied by the emitter's opacityOverLife
    base::Range opacity{1.0f, 1.0f};
    base::Range brightness{1.0f, 1.0f}; ///< [1] factor on the color

    base::Range angle{0.0f, 0.0f}; ///< [rad] rotation angle at birth
    base::Range spin{0.0f, 0.0f};  ///< [rad/s]
    FrameClock frames = FrameClock::None;
    float framesPerSecond = 0.0f;
    base::Range firstFrame{0.0f, 0.0f}; ///< [1] frame at birth; may be fractional

    // Curves over speed, t = speed / fastest in [0, 1]. They multiply the curves over life. If fastest is 0,
    // they are not used.
    float fastest = 0.0f; ///< [m/s]
    base::ColorCurve colorOverSpeed{std::array{1.0f, 1.0f, 1.0f}};
    base::ScalarCurve sizeOverSpeed{std::array{1.0f}};
    base::ScalarCurve opacityOverSpeed{std::array{1.0f}};
};

} // namespace fx::sim
