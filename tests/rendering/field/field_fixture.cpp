#include "tests/rendering/field/field_fixture.h"

#include "rendering/gl/gl_read_texture.h"
#include "rendering/stage/stage_camera.h"

#include <algorithm>

namespace fx::test {

using namespace render;

CameraView FieldTest::camera(const glm::dvec3& position, const glm::dvec3& target)
{
    return perspectiveView({position, target}, 0.8f, float(kFieldWidth) / float(kFieldHeight), 0.05f);
}

FieldTextures FieldTest::importTextures()
{
    FieldTextures textures;
    ResourceId* const ids[] = {&textures.medium, &textures.scatter, &textures.shares};
    for (size_t i = 0; i < volumes_.size(); ++i)
        *ids[i] = graph_->importTexture(
            {"field", volumes_[i].width(), volumes_[i].height(), kFieldFormats[i]}, volumes_[i].name());
    textures.table =
        graph_->importTexture({"table", table_.width(), table_.height(), Format::R32F}, table_.name());
    return textures;
}

ResourceId FieldTest::importTexelsOfFields()
{
    ResourceId texels;
    graph_->addPass("texels", [&](FrameGraph::Builder& builder) {
        texels = builder.write(
            builder.create({"texels", kFieldColumns, rowsOfTexels(texels_.texels().size(), kFieldColumns),
                            Format::RGBA32F}));
        return [](Backend&) {};
    });
    return FieldTexelPass::addTo(*graph_, importBytes(std::as_bytes(texels_.texels())),
                                 texels_.texels().size(), texels);
}

void FieldTest::fill(const FieldScene& scene, int resolution, bool layers)
{
    plan_.build(scene.inputs(16 * kFieldWidth, 16 * kFieldHeight, resolution));
    texels_.build(plan_, {}, {});
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
    auto table = GlTexture::create(*device_, kTableColumns, rowsOfTexels(plan_.table().size(), kTableColumns),
                                   glInternalFormat(Format::R32F), "table");
    ASSERT_TRUE(table.ok()) << table.status().message();
    table_ = std::move(*table);
    const FieldFillPass::Inputs in{importBytes(std::as_bytes(std::span(scene.balls))),
                                   importTexelsOfFields(),
                                   importBytes(std::as_bytes(plan_.bricks())),
                                   importBytes(std::as_bytes(plan_.balls())),
                                   importTextures(),
                                   uint32_t(plan_.bricks().size())};
    const FieldTextures filled = FieldFillPass::addTo(*graph_, in).textures;
    graph_->keep(filled.scatter);
    graph_->keep(filled.table);
    if (layers)
        graph_->keep(filled.shares);
    execute(filled.medium);
}

std::vector<float> FieldTest::march(const CameraView& camera, const Window& window, size_t target)
{
    graph_->begin();
    ViewBlock view = makeViewBlock(camera, kFieldWidth, kFieldHeight);
    view.rayOriginX.w = std::max(view.rayOriginX.w, window.from);
    const std::vector<float> same(size_t(kFieldWidth * kFieldHeight), window.wall);
    const ResourceId distance =
        importScalar(kFieldWidth, kFieldHeight, window.walls.empty() ? same : window.walls);
    const MediaPass::Inputs media{{}, distance, kFieldWidth, kFieldHeight, view, window.layers};
    const FieldMarchPass::Inputs in{&media, importTextures(), importTexelsOfFields(),
                                    importBytes(std::as_bytes(texels_.tiles()))};
    const auto out = FieldMarchPass::addTo(*graph_, in, {});
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
