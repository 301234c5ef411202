/// @file stage_renderer.h
/// A small host for tools and tests: draws an opaque triangle mesh before a background into color and depth,
/// as a game would before it calls fxView_Render.
///
/// Threads: [GL thread].
#pragma once

#include "foundation/result/status.h"
#include "rendering/frame/view_types.h"
#include "rendering/lights/effect_lights.h"
#include "rendering/lights/slices/media_shadow.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace fx::render {

class GlDevice;

/// Triangles with a diffuse color per vertex; three vertices a triangle, counter-clockwise seen from outside.
struct StageMesh
{
    glm::dvec3 origin{0.0};           ///< [m] world position that the vertices are relative to
    std::vector<glm::vec3> positions; ///< [m] relative to `origin`
    std::vector<glm::vec3> normals;   ///< unit
    std::vector<glm::vec3> colors;    ///< [0, 1] linear albedo
};

/// Background behind the mesh.
struct StageBackground
{
    glm::vec3 luminance{0.0f};    ///< [cd/m2] overhead, used when `image` is empty
    glm::vec3 horizon{0.0f};      ///< [cd/m2] at and below eye height; equal to `luminance` for a plain color
    int width = 0, height = 0;    ///< [pixel] of `image`
    std::vector<glm::vec3> image; ///< [cd/m2], row by row from the top
    bool panorama = false;        ///< true: equirectangular around the eye; false: fills the view
};

/// A light besides sun and sky.
struct StageLight
{
    HostLight light;
    /// [1] 0..1 wrap of diffuse light beyond the terminator, for wide lights such as fireballs.
    float wrap = 0.0f;
    std::optional<MediaShadowBlock> shadow = {}; ///< that media cast in it; none: they cast none
};

StageLight effectStageLight(const EffectLight& light);

/// How the picture of a stage is lit.
struct StageLighting
{
    Lighting lighting;
    std::span<const StageLight> lights{}; ///< up to kMaxStageLights, of which kMaxStageShadows have shadows
    MediaShadowBlock sunShadow;           ///< that media cast in the sun; without planes they cast none
    uint32_t shadowTexture = 0; ///< GL name of the planes of all shadows, filtered linearly; 0: none
};

constexpr size_t kMaxStageLights = 16;
constexpr size_t kMaxStageShadows = 5; ///< that of the sun is one

/// Diffuse surfaces under a sun with a shadow map, a sky and lights, in the shadow of media.
class StageRenderer
{
public:
    explicit StageRenderer(GlDevice* device);
    ~StageRenderer();

    base::Status setMesh(const StageMesh& mesh);
    base::Status setBackground(const StageBackground& background);

    /// Draws into textures of the stage, which are valid until the next call: RGBA32F color [cd/m2 times
    /// exposure] and a 32-bit float depth texture.
    base::Status render(const CameraView& camera, const Lighting& lighting,
                        std::span<const EffectLight> lights, float exposureEv100, int width, int height);
    base::Status render(const CameraView& camera, const StageLighting& lighting, float exposureEv100,
                        int width, int height);

    /// The shadow map of the last picture, for media. @param origin [m] CameraView::origin of their frame
    HostShadowMap sunShadow(const glm::dvec3& origin) const;

    uint32_t colorTexture() const;
    uint32_t depthTexture() const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

} // namespace fx::render
