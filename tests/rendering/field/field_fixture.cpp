#include "tests/rendering/field/field_fixture.h"

#include "rendering/gl/gl_read_texture.h"
#include "rendering/stage/stage_camera.h"

namespace fx::test {

using namespace render;

CameraView FieldTest::camera(const glm::dvec3& position, const glm::dvec3& target)
{
    return perspectiveView({position, target}, 0.8f, float(kFieldWidth) / float(kFieldHeight), 0.05f);
}

void FieldTest::importTextures()
{
    ResourceId* const ids[] = {&source_.textures.medium, &source_.textures.scatter, &source_.textures.shares};
    source_.textures = {};
    for (size_t i = 0; i < volumes_.size(); ++i)
        *ids[i] = graph_->importTexture(
            {"field", volumes_[i].width(), volumes_[i].height(), kFieldFormats[i]}, volumes_[i].name());
}

void FieldTest::fill(const FieldScene& scene, int resolution, bool layers)
{
    plan_.build(scene.inputs(16 * kFieldWidth, 16 * kFieldHeight, resolution));
    graph_->begin();
    volumes_.clear();
    const int depth = int(plan_.bricks().size() + 255) / 256;
    for (size_t i = 0; i < (layers ? 3 : 2); ++i) {
        auto made =
            GlTexture::createVolume(*device_, kBrickColumns * kBrickSamples, kBrickColumns * kBrickSamples,
                                    depth * kBrickSamples, glInternalFormat(kFieldFormats[i]), "field");
        ASSERT_TRUE(made.ok()) << made.status().message();
        volumes_.push_back(std::move(*made));
    }
    importTextures();
    const FieldFillPass::Inputs in{importBytes(std::as_bytes(std::span(scene.balls))),
                                   importBytes(std::as_bytes(plan_.fields())),
                                   importBytes(std::as_bytes(plan_.bricks())),
                                   importBytes(std::as_bytes(plan_.balls())),
                                   source_.textures,
                                   uint32_t(plan_.bricks().size())};
    source_.textures = FieldFillPass::addTo(*graph_, in).textures;
    graph_->keep(source_.textures.scatter);
    if (layers)
        graph_->keep(source_.textures.shares);
    execute(source_.textures.medium);
}

std::vector<float> FieldTest::march(const CameraView& camera, const Window& window, size_t target)
{
    graph_->begin();
    importTextures();
    source_.fields = importBytes(std::as_bytes(plan_.fields()));
    source_.table = importBytes(std::as_bytes(plan_.table()));
    source_.tiles = importBytes(std::as_bytes(plan_.tiles()));
    source_.tileFields = importBytes(std::as_bytes(plan_.tileFields()));
    source_.tileCount = uint32_t(plan_.tiles().size());
    // all shells but for the nearest, which ends at `from`
    const float before = (plan_.farthest() - window.from) / float(FieldSource::kShells - 1);
    source_.placeShells(window.from - before, plan_.farthest());
    const std::vector<float> same(size_t(kFieldWidth * kFieldHeight), window.wall);
    const ResourceId distance =
        importScalar(kFieldWidth, kFieldHeight, window.walls.empty() ? same : window.walls);
    const DrawBatch batch{0, 0, window.from > 0.0f ? FieldSource::kShells - 1 : FieldSource::kShells,
                          &source_};
    const auto out = MediaPass::addTo(*graph_,
                                      {{&batch, 1},
                                       distance,
                                       kFieldWidth,
                                       kFieldHeight,
                                       makeViewBlock(camera, kFieldWidth, kFieldHeight),
                                       window.layers},
                                      {});
    const ResourceId result = window.layers ? out.layers[target] : out.media;
    execute(result);
    const bool isScalar = window.layers && target >= MediaPass::DepthMoment;
    return read(result, isScalar ? 1 : 4);
}

std::vector<float> FieldTest::picture(const std::vector<FieldBall>& balls, const CameraView& camera,
                                      int resolution, const Window& window)
{
    fill(FieldScene(balls, camera), resolution, window.layers);
    return march(camera, window);
}

std::vector<float> FieldTest::texels(size_t texture, int channels)
{
    const GlTexture& volume = volumes_[texture];
    return readTexture(*device_, volume.name(), volume.width(), volume.height() * volume.depth(), channels);
}

size_t FieldTest::texelOf(size_t brick, const glm::ivec3& s) const
{
    const size_t side = size_t(kBrickColumns * kBrickSamples);
    const size_t x = brick % 16 * kBrickSamples + size_t(s.x);
    const size_t y = brick / 16 % 16 * kBrickSamples + size_t(s.y);
    const size_t z = brick / 256 * kBrickSamples + size_t(s.z);
    return x + side * (y + side * z);
}

} // namespace fx::test
