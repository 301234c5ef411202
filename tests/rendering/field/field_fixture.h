/// @file field_fixture.h
/// Fills, lights and marches voxel fields on a software OpenGL.
#pragma once

#include "rendering/field/field_fill_pass.h"
#include "rendering/field/field_light_pass.h"
#include "rendering/field/field_march_pass.h"
#include "rendering/field/field_texels.h"
#include "rendering/passes/media_pass.h"
#include "tests/rendering/field/field_scenes.h"
#include "tests/rendering/passes/post_pass_harness.h"

#include <limits>

namespace fx::test {

constexpr int kFieldWidth = 96, kFieldHeight = 64;

class FieldTest : public PostPass
{
protected:
    /// Range of a ray in which the field is visible.
    struct Window
    {
        float wall = std::numeric_limits<float>::infinity(); ///< [m] along the ray, what is opaque
        float from = 0.0f;                                   ///< [m] depth along the axis
        bool layers = false;
        std::vector<float> walls = {}; ///< of each pixel, in place of `wall`
    };

    /// Plans as for a large picture, and fills the field. The test keeps the textures.
    void fill(const FieldScene& scene, int resolution, bool layers = false);
    /// RGBA of each pixel; with layers, of the requested target.
    std::vector<float> march(const render::CameraView& camera, const Window& window,
                             size_t target = render::MediaPass::Fire);
    std::vector<float> picture(const std::vector<FieldBall>& balls, const render::CameraView& camera,
                               int resolution, const Window& window);
    std::vector<float> texels(size_t texture, int channels = 4); ///< 0 medium, 1 scatter, 2 shares
    size_t texelOf(size_t brick, const glm::ivec3& s) const;     ///< index, in texels

    static render::CameraView camera(const glm::dvec3& position, const glm::dvec3& target);

    render::FieldPlan plan_{memory_};

    render::FieldTextures importTextures(); ///< those of fill(), in this frame
    render::ResourceId importTexelsOfFields();

private:
    render::FieldTexels texels_{memory_};
    std::vector<render::GlTexture> volumes_;
    render::GlTexture table_;
};

} // namespace fx::test
