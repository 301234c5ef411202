/// @file stage_renderer.h
/// A small host for tools and tests. The host draws an opaque triangle mesh and a background to a color
/// texture and a depth texture, as a game does before it calls fxView_Render.
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

/// Triangles with a diffuse color per vertex. Each triangle has three vertices of its own, counterclockwise
/// seen from outside.
struct StageMesh
{
    glm::dvec3 origin{0.0};           ///< [m] world position to which the vertices are relative
    std::vector<glm::vec3> positions; ///< [m] positions relative to `origin`
    std::vector<glm::vec3> normals;   ///< unit vectors
    std::vector<glm::vec3> colors;    ///< [0, 1] linear albedo
    /// True: relief and color of level ground at the height of `origin` vary by formula soil-texture.
    /// `colors` are the mean. Only the figures and props cast shadows.
    bool isSoil = false;
    /// Number of vertices, from the first on, of figures that show the scale; effects do not collide with
    /// them.
    size_t figureVertices = 0;
    /// Number of vertices, from those of the figures on, of props (stage_props.h); effects do not collide
    /// with them.
    size_t propVertices = 0;
    /// Number of vertices, at the end, of water: surfaces that reflect the sky, the sun and the lights by
    /// Fresnel's equations. Those that are level have waves. `colors` are the albedo of the light that comes
    /// back out of the water. It casts no shadow. The reference renderers draw it as a diffuse surface.
    size_t waterVertices = 0;

    size_t addedVertices() const { return figureVertices + propVertices; } ///< all that is not the stage
};

/// Background behind the mesh.
struct StageBackground
{
    glm::vec3 luminance{0.0f}; ///< [cd/m2] luminance at the zenith, used if `image` is empty
    /// [cd/m2] Luminance at and below the horizon; equal to `luminance` for a uniform color.
    glm::vec3 horizon{0.0f};
    int width = 0, height = 0;    ///< [pixel] size of `image`
    std::vector<glm::vec3> image; ///< [cd/m2] top row first
    bool panorama = false; ///< true: `image` is equirectangular around the eye; false: it fills the picture
    bool hasHills =
        false; ///< true: wooded hills (formula wooded-horizon) hide the horizon, if `image` is empty
};

/// A light of the scene, other than sun and sky.
struct StageLight
{
    HostLight light;
    /// [1] Distance by which diffuse light extends beyond the terminator, 0..1 ("wrap lighting"), for large
    /// lights such as fireballs.
    float wrap = 0.0f;
    /// Media shadow in this light; without a value, media cast no shadow.
    std::optional<MediaShadowBlock> shadow = {};
};

StageLight effectStageLight(const EffectLight& light);

/// Lighting of a stage.
struct StageLighting
{
    Lighting lighting;
    std::span<const StageLight> lights{}; ///< lights, of which at most kMaxStageLights are used
    /// Media shadow in the light of the sun. If the block has no planes, media cast no shadow.
    MediaShadowBlock sunShadow;
    /// GL name of the texture of light slices for all media shadows, with linear filter; 0: no media shadows.
    uint32_t shadowTexture = 0;
};

constexpr size_t kMaxStageLights = 16;
constexpr size_t kMaxStageShadows =
    5; ///< largest number of media shadows, including the shadow in the light of the sun

/// Draws diffuse surfaces and water lit by a sun with a shadow map, a sky and lights, with shadows of media.
class StageRenderer
{
public:
    explicit StageRenderer(GlDevice* device);
    ~StageRenderer();

    /// Sets the mesh.
    /// @return InvalidArgument if positions, normals and colors differ in number, or an error of GL
    base::Status setMesh(const StageMesh& mesh);
    /// Sets the background.
    /// @return InvalidArgument if `image` does not have width * height pixels, or an error of GL
    base::Status setBackground(const StageBackground& background);

    /// Draws to textures of the stage: RGBA32F color [cd/m2 times exposure] and 32-bit float depth. The
    /// textures are valid until the next call.
    /// @param width, height [pixel] size of the textures
    base::Status render(const CameraView& camera, const Lighting& lighting,
                        std::span<const EffectLight> lights, float exposureEv100, int width, int height);
    base::Status render(const CameraView& camera, const StageLighting& lighting, float exposureEv100,
                        int width, int height);

    /// The sun's shadow map of the last picture, for media.
    /// @param origin [m] CameraView::origin of the frame that draws the media
    HostShadowMap sunShadow(const glm::dvec3& origin) const;

    uint32_t colorTexture() const;
    uint32_t depthTexture() const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

} // namespace fx::render
