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
    /// Range of rays in which the field is visible.
    struct Window
    {
        /// [m] distance of opaque surfaces along the ray
        float wall = std::numeric_limits<float>::infinity();
        float from = 0.0f; ///< [m] depth along the camera's axis at which the range begins
        bool layers = false;
        /// [m] distance of opaque surfaces for each pixel; replaces `wall` if not empty
        std::vector<float> walls = {};
    };

    /// Plans a field for a large picture and fills it. The test owns the textures.
    void fill(const FieldScene& scene, int resolution, bool layers = false);
    /// Marches rays through the field. @return RGBA of each pixel; with layers, of the target `target`
    std::vector<float> march(const render::CameraView& camera, const Window& window,
                             size_t target = render::MediaPass::Fire);
    std::vector<float> picture(const std::vector<FieldBall>& balls, const render::CameraView& camera,
                               int resolution, const Window& window);
    /// Reads a texture of the field: 0 for the medium, 1 for the scattering, 2 for the fractions of layers.
    std::vector<float> texels(size_t texture, int channels = 4);
    size_t texelOf(size_t brick, const glm::ivec3& s) const; ///< index of the texel of sample `s`

    static render::CameraView camera(const glm::dvec3& position, const glm::dvec3& target);

    render::FieldPlan plan_{memory_};

    render::FieldTextures importTextures(); ///< imports the textures that fill() created into this frame
    render::ResourceId importTexelsOfFields();

private:
    render::FieldTexels texels_{memory_};
    std::vector<render::GlTexture> volumes_;
    render::GlTexture table_;
};

} // namespace fx::test
