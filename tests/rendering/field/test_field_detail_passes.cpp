// Detail of fields on the GPU against the same on the processor.
#include "rendering/field/field_fill_pass.h"
#include "rendering/field/field_texels.h"
#include "rendering/field/lump_tile_pass.h"
#include "rendering/field_detail/field_detail_numbers.h"
#include "rendering/gl/gl_read_texture.h"
#include "rendering/gl/gl_texture.h"
#include "rendering/stage/stage_camera.h"
#include "shaders/formulas/formula.h"
#include "tests/rendering/field/field_scenes.h"
#include "tests/rendering/passes/post_pass_harness.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

using namespace fx;
using namespace fx::render;
using namespace fx::test;

namespace {

constexpr int kSide = kBrickColumns * kBrickSamples;

FieldDetailNumbers numbers()
{
    FieldDetailNumbers n;
    n.generations[0] = {0.8f, 1.0f, {1.3f, 6.2f, 4.4f}};
    n.generations[1] = {0.7f, 0.9f, {3.1f, 0.2f, 7.7f}};
    n.fade = 0.35f;
    n.thinnest = 0.3f;
    n.densest = 20.0f;
    n.softening = 1.5f;
    return n;
}

/// Coordinates are those of the eye.
FieldDetailBlock blockOf(const FieldDetailNumbers& n)
{
    FieldDetailBlock block{};
    for (int g = 0; g < 2; ++g) {
        const FieldDetailNumbers::Generation& own = n.generations[size_t(g)];
        for (int row = 0; row < 3; ++row) {
            block.rows[3 * g + row][row] = own.growth / own.length;
            block.rows[3 * g + row].w = own.offset[row];
        }
        block.lumps[g] = own.length / own.growth;
    }
    block.erosion = {n.length(), n.thinnest, n.densest, n.ramp};
    block.noise = {n.gain, n.fade, n.cooling, n.glow};
    block.lumps.z = 1.0f;
    block.lumps.w = float(kMaxDetailOctaves);
    block.soft.x = n.softening;
    return block;
}

} // namespace

class FieldDetailPasses : public PostPass
{
protected:
    GlTexture volume(int side, int depth, Format format)
    {
        auto made = GlTexture::createVolume(*device_, side, side, depth, glInternalFormat(format), "test");
        EXPECT_TRUE(made.ok()) << made.status().message();
        return std::move(*made);
    }
    ResourceId import(const GlTexture& texture, Format format)
    {
        return graph_->importTexture({"test", texture.width(), texture.height(), format}, texture.name());
    }
    std::vector<float> texels(const GlTexture& texture, int channels)
    {
        return readTexture(*device_, texture.name(), texture.width(), texture.height() * texture.depth(),
                           channels);
    }
};

TEST_F(FieldDetailPasses, lumpsAreThoseOfTheProcessor)
{
    graph_->begin();
    const GlTexture tile = volume(kLumpTileTexels, kLumpTileTexels, Format::R32F);
    execute(LumpTilePass::addTo(*graph_, import(tile, Format::R32F)));
    const std::vector<float> drawn = texels(tile, 1);
    const LumpTile wanted(kLumpTileTexels);
    ASSERT_EQ(drawn.size(), wanted.values().size());
    for (size_t i = 0; i < drawn.size(); ++i)
        ASSERT_NEAR(drawn[i], wanted.values()[i], 1e-3f) << i;
}

TEST_F(FieldDetailPasses, whatDetailChangesIsWhatTheProcessorFinds)
{
    std::vector<FieldBall> balls;
    for (int i = 0; i < 40; ++i) {
        const float a = 2.39996f * float(i), r = 0.11f * std::sqrt(float(i));
        balls.push_back(
            {.center = {r * std::cos(a), r * std::sin(a), -4.0f - 0.3f * std::sin(1.7f * float(i))},
             .radius = 0.45f,
             .crossSection = i % 3 == 0 ? 0.03f : 0.25f});
    }
    const CameraView camera = perspectiveView({{0, 0, 0}, {0, 0, -4}}, 0.8f, 1.5f, 0.05f);
    FieldScene scene(balls, camera);
    for (BlobEffect& effect : scene.effects)
        effect.detail = 0;
    FieldPlan plan(memory_);
    plan.build(scene.inputs(1536, 1024, 96));
    std::vector<BlobMaterial> materials(scene.balls.size());
    for (size_t i = 0; i < materials.size(); ++i)
        for (int g = 0; g < 2; ++g)
            materials[i].carried[g] =
                glm::vec4(0.3f * std::sin(float(i)), 0.2f * float(g), 0.1f * std::cos(float(i)), 0);

    graph_->begin();
    const GlTexture tile = volume(kLumpTileTexels, kLumpTileTexels, Format::R32F);
    const int depth = int(plan.bricks().size() + 255) / 256 * kBrickSamples;
    std::vector<GlTexture> volumes;
    for (const size_t f : {0, 1, 3, 4, 5})
        volumes.push_back(volume(kSide, depth, kFieldFormats[f]));
    FieldTextures textures;
    textures.medium = import(volumes[0], kFieldFormats[0]);
    textures.scatter = import(volumes[1], kFieldFormats[1]);
    textures.material[0] = import(volumes[2], kFieldFormats[3]);
    textures.material[1] = import(volumes[3], kFieldFormats[4]);
    textures.change = import(volumes[4], kFieldFormats[5]);
    const FieldDetailBlock block = blockOf(numbers());
    FieldTexels listed(memory_);
    listed.build(plan, {&block, 1}, {scene.balls, materials});
    std::vector<float> words(size_t(4 * kFieldColumns), 0.0f);
    ASSERT_LE(listed.texels().size(), size_t(kFieldColumns));
    std::memcpy(words.data(), listed.texels().data(), listed.texels().size_bytes());
    auto made = GlTexture::create(*device_, kTableColumns, rowsOfTexels(plan.table().size(), kTableColumns),
                                  glInternalFormat(Format::R32F), "table");
    ASSERT_TRUE(made.ok());
    const GlTexture table = std::move(*made);
    textures.table = import(table, Format::R32F);
    const ResourceId lumps = LumpTilePass::addTo(*graph_, import(tile, Format::R32F));
    textures = FieldFillPass::addTo(*graph_, {importBytes(std::as_bytes(std::span(scene.balls))),
                                              importTexels(kFieldColumns, 1, Format::RGBA32F, words),
                                              importBytes(std::as_bytes(plan.bricks())),
                                              importBytes(std::as_bytes(plan.balls())), textures,
                                              uint32_t(plan.bricks().size()),
                                              importBytes(std::as_bytes(std::span(materials))), lumps})
                   .textures;
    for (const ResourceId id :
         {textures.scatter, textures.table, textures.material[0], textures.material[1], textures.change})
        graph_->keep(id);
    execute(textures.medium);

    const std::vector<float> medium = texels(volumes[0], 4), first = texels(volumes[2], 4),
                             second = texels(volumes[3], 4), changes = texels(volumes[4], 1);
    const FieldBlock& field = plan.fields()[0];
    const LumpTile wanted(kLumpTileTexels);
    double most = 0, sum = 0;
    float mostThinning = 0;
    size_t count = 0, eroded = 0;
    for (size_t b = 0; b < plan.bricks().size(); ++b)
        for (int k = 0; k < kBrickSamples * kBrickSamples * kBrickSamples; ++k) {
            const glm::ivec3 s(k % kBrickSamples, k / kBrickSamples % kBrickSamples, k / 81);
            const size_t at = 4 * (size_t(int(b) % 16 * 9 + s.x) +
                                   size_t(kSide) * (size_t(int(b) / 16 % 16 * 9 + s.y) +
                                                    size_t(kSide) * size_t(int(b) / 256 * 9 + s.z)));
            const float extinction = medium[at + 3];
            if (!(extinction > 0.05f))
                continue;
            const uint32_t place = plan.bricks()[b].place;
            const glm::vec3 p =
                glm::vec3(field.corner) +
                field.corner.w * glm::vec3(8 * glm::ivec3(place & 1023, place >> 10 & 1023, place >> 20) + s);
            SmoothMedium smooth{extinction, {}, second[at + 3] * field.limits.y / extinction};
            mostThinning = std::max(mostThinning, smooth.thinning);
            for (size_t g = 0; g < 2; ++g) {
                const FieldDetailNumbers::Generation own = numbers().generations[g];
                const float* const carried = (g == 0 ? first : second).data() + at;
                smooth.place[g] = own.growth * p + own.length * field.limits.y / extinction *
                                                       glm::vec3(carried[0], carried[1], carried[2]);
            }
            const float share =
                detailAt(numbers(), wanted, smooth, 1.22f * field.corner.w, kMaxDetailOctaves).share;
            const double error =
                std::abs(double(changes[at / 4] * field.limits.y - (share - 1.0f) * extinction));
            most = std::max(most, error / double(field.limits.y));
            sum += error / double(field.limits.y);
            eroded += share < 1.0f ? 1 : 0;
            ++count;
        }
    size_t unseen = 0; // bricks that rays skip: detail leaves nothing of any sample
    const std::vector<float> numbered = readTexture(*device_, table.name(), table.width(), table.height(), 1);
    for (size_t b = 0; b < plan.bricks().size(); ++b) {
        int eighths = 0; // samples on their faces are in both
        for (int k = 0; k < kBrickSamples * kBrickSamples * kBrickSamples; ++k) {
            const glm::ivec3 at(k % 9, k / 9 % 9, k / 81);
            const size_t texel = 4 * (size_t(int(b) % 16 * 9 + at.x) +
                                      size_t(kSide) * (size_t(int(b) / 16 % 16 * 9 + at.y) +
                                                       size_t(kSide) * size_t(int(b) / 256 * 9 + at.z)));
            const float extinction = medium[texel + 3];
            if (!(extinction > 0.0f &&
                  meanErodedShare(numbers(), extinction, second[texel + 3] * field.limits.y / extinction) >
                      0.0f))
                continue;
            for (int e = 0; e < 8; ++e)
                if ((e & 1 ? at.x >= 4 : at.x <= 4) && (e & 2 ? at.y >= 4 : at.y <= 4) &&
                    (e & 4 ? at.z >= 4 : at.z <= 4))
                    eighths |= 1 << e;
        }
        const bool isSeen = eighths != 0;
        const uint32_t place = plan.bricks()[b].place;
        const size_t entry =
            size_t(field.bricks.w) + (place & 1023) +
            size_t(field.bricks.x) * ((place >> 10 & 1023) + size_t(field.bricks.y) * (place >> 20));
        EXPECT_EQ(std::abs(numbered[entry]), float(b + 1) + float(eighths) / 256.0f);
        EXPECT_EQ(numbered[entry] > 0.0f, isSeen) << b;
        unseen += isSeen ? 0 : 1;
    }
    EXPECT_GT(unseen, 0u);
    EXPECT_GT(mostThinning, 1.0f);
    ASSERT_GT(count, 1000u);
    EXPECT_GT(eroded, count / 4);
    EXPECT_LT(sum / double(count), 2e-3); // places are half floats
    EXPECT_LT(most, 0.2);
}
