#include "foundation/random/philox.h"
#include "rendering/frame_graph/recording_backend.h"
#include "rendering/passes/blob_instance.h"
#include "rendering/passes/heat_offset_pass.h"
#include "rendering/passes/heat_shimmer_pass.h"
#include "tests/rendering/passes/post_pass_harness.h"

#include <glm/gtc/matrix_transform.hpp>

#include <cmath>
#include <limits>
#include <numeric>

namespace {

using namespace fx;
using namespace fx::render;
using test::Picture;

constexpr float kInf = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

/// Settings whose largest offset is `pixels` in a picture of this height.
ShimmerSettings limit(float pixels, const Picture& picture)
{
    return {.strength = 1.0f, .maxOffset = pixels * 720.0f / float(picture.height)};
}

/// The same displacement everywhere, by gas of weight 1 at `distance` [m].
Picture uniformHeat(const Picture& like, float x, float y, float distance)
{
    return {like.width, like.height, {x, y, 1.0f, distance}};
}

/// Red is x, green is y.
Picture ramp(int width, int height)
{
    Picture picture(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            picture.at(x, y)[0] = float(x);
            picture.at(x, y)[1] = float(y);
        }
    return picture;
}

Picture noise(int width, int height, uint64_t seed)
{
    Picture picture(width, height);
    for (size_t i = 0; i < picture.texels.size(); i += 4) {
        const auto u = base::randomUnit4(seed, 0, i, base::RandomPurpose::Noise);
        std::copy_n(u.begin(), 4, picture.texels.begin() + ptrdiff_t(i));
    }
    return picture;
}

class HeatShimmer : public test::PostPass
{
protected:
    /// An area that is the whole picture.
    std::span<const HotArea> wholeOf(int width, int height)
    {
        whole_ = {0, 0, uint32_t(width), uint32_t(height)};
        return {&whole_, 1};
    }

    std::vector<float> shimmer(const Picture& picture, const Picture& heat, std::span<const float> distances,
                               const ShimmerSettings& settings)
    {
        graph_->begin();
        const ResourceId color = import(picture);
        const ResourceId distance = importScalar(picture.width, picture.height, distances);
        const auto out = HeatShimmerPass::addTo(*graph_, {color, distance, import(heat),
                                                          wholeOf(picture.width, picture.height),
                                                          picture.width, picture.height, false, settings});
        EXPECT_NE(out.color.index, color.index);
        execute(out.color);
        return read(out.color);
    }

    std::vector<float> shimmer(const Picture& picture, const Picture& heat, float distance,
                               const ShimmerSettings& settings)
    {
        const std::vector<float> distances(size_t(picture.width) * size_t(picture.height), distance);
        return shimmer(picture, heat, distances, settings);
    }

private:
    HotArea whole_{};
};

const float* pixelOf(const std::vector<float>& texels, const Picture& like, int x, int y)
{
    return &texels[(size_t(y) * size_t(like.width) + size_t(x)) * 4];
}

} // namespace

TEST_F(HeatShimmer, withoutDisplacementEveryBitStays)
{
    Picture picture = noise(61, 43, 1);
    picture.at(5, 5)[0] = kNan;
    picture.at(6, 5)[1] = -kInf;
    picture.at(7, 5)[2] = 1e-42f;
    const ShimmerSettings settings = limit(10.0f, picture);
    EXPECT_EQ(
        test::differentBits(shimmer(picture, uniformHeat(picture, 0, 0, 5), kInf, settings), picture.texels),
        0u);
    const Picture noHeat(61, 43, {3.0f, 4.0f, 0.0f, 0.0f});
    EXPECT_EQ(test::differentBits(shimmer(picture, noHeat, kInf, settings), picture.texels), 0u);
}

TEST_F(HeatShimmer, aConstantPictureStaysConstantBitForBit)
{
    const Picture picture(64, 40, {0.1f, 3.7e5f, 1.3e-7f, 0.9f});
    for (const float amplitude : {0.01f, 0.37f, 3.3f, 50.0f, 1000.0f}) {
        Picture heat = noise(64, 40, 2);
        for (size_t i = 0; i < heat.texels.size(); i += 4) {
            heat.texels[i] = (heat.texels[i] - 0.5f) * amplitude;
            heat.texels[i + 1] = (heat.texels[i + 1] - 0.5f) * amplitude;
            heat.texels[i + 2] = 1.0f;
        }
        const auto out = shimmer(picture, heat, kInf, limit(20.0f, picture));
        EXPECT_EQ(test::differentBits(out, picture.texels), 0u) << amplitude;
    }
}

TEST_F(HeatShimmer, wholePixelsAreMovedExactlyAndPartsAreInterpolated)
{
    const Picture picture = noise(80, 60, 3);
    const ShimmerSettings settings = limit(8.0f, picture);
    const auto moved = shimmer(picture, uniformHeat(picture, 3.0f, -2.0f, 5.0f), kInf, settings);
    Picture source = picture;
    for (int y = 8; y < 52; ++y)
        for (int x = 8; x < 72; ++x)
            ASSERT_EQ(pixelOf(moved, picture, x, y)[0], source.at(x + 3, y - 2)[0]);

    const Picture lines = ramp(80, 60);
    const auto between = shimmer(lines, uniformHeat(lines, 1.25f, 0.5f, 5.0f), kInf, settings);
    EXPECT_EQ(pixelOf(between, lines, 30, 20)[0], 31.25f);
    EXPECT_EQ(pixelOf(between, lines, 30, 20)[1], 20.5f);
}

TEST_F(HeatShimmer, theNearerTheSceneToTheGasTheLessItMoves)
{
    const Picture lines = ramp(80, 60);
    const ShimmerSettings settings = limit(8.0f, lines);
    const Picture heat = uniformHeat(lines, 4.0f, 0.0f, 5.0f);
    EXPECT_EQ(pixelOf(shimmer(lines, heat, kInf, settings), lines, 40, 30)[0], 44.0f);
    EXPECT_EQ(pixelOf(shimmer(lines, heat, 10.0f, settings), lines, 40, 30)[0], 42.0f);
    EXPECT_EQ(pixelOf(shimmer(lines, heat, 5.0f, settings), lines, 40, 30)[0], 40.0f);
    EXPECT_EQ(pixelOf(shimmer(lines, heat, 2.0f, settings), lines, 40, 30)[0], 40.0f);
}

TEST_F(HeatShimmer, displacementIsLimitedAndFadesBeforeTheBorder)
{
    const Picture lines = ramp(90, 70);
    for (const float amplitude : {3.0f, 100.0f, 1e6f, 1e15f}) {
        const auto out =
            shimmer(lines, uniformHeat(lines, amplitude, -amplitude, 5.0f), kInf, limit(6.0f, lines));
        for (int y = 0; y < 70; ++y)
            for (int x = 0; x < 90; ++x) {
                const float dx = pixelOf(out, lines, x, y)[0] - float(x);
                const float dy = pixelOf(out, lines, x, y)[1] - float(y);
                const float edge = float(std::min(std::min(x, 89 - x), std::min(y, 69 - y)));
                ASSERT_LE(std::hypot(dx, dy), std::min(6.0f, edge) * 1.0001f) << x << ", " << y;
            }
        EXPECT_GT(pixelOf(out, lines, 45, 35)[0], 47.0f);
    }
}

TEST_F(HeatShimmer, aFrameOfNanAroundThePictureNeverGetsIn)
{
    Picture picture = noise(72, 56, 4);
    for (int y = 0; y < 56; ++y)
        for (int x = 0; x < 72; ++x)
            if (x < 9 || x >= 63 || y < 9 || y >= 47)
                std::fill_n(picture.at(x, y), 4, kNan);
    for (const float angle : {0.0f, 1.6f, 3.1f, 4.7f}) {
        const Picture heat = uniformHeat(picture, 7.3f * std::cos(angle), 7.3f * std::sin(angle), 5.0f);
        const auto out = shimmer(picture, heat, kInf, limit(8.0f, picture));
        for (int y = 9; y < 47; ++y)
            for (int x = 9; x < 63; ++x)
                ASSERT_TRUE(std::isfinite(pixelOf(out, picture, x, y)[0])) << x << ", " << y;
    }
}

TEST_F(HeatShimmer, aBrokenPixelHarmsOnlyItself)
{
    for (const float broken : {kNan, kInf, -kInf}) {
        Picture picture = noise(50, 40, 5);
        picture.at(25, 20)[1] = broken;
        const auto out = shimmer(picture, uniformHeat(picture, 1.4f, 0.7f, 5.0f), kInf, limit(8.0f, picture));
        for (int y = 0; y < 40; ++y)
            for (int x = 0; x < 50; ++x)
                ASSERT_TRUE(std::isfinite(pixelOf(out, picture, x, y)[1]) || (x == 25 && y == 20))
                    << x << ", " << y;
    }
}

TEST_F(HeatShimmer, brokenHeatLeavesThePicture)
{
    const Picture picture = noise(50, 40, 6);
    for (const Picture& heat : {Picture(50, 40, {kNan, 1, 1, 5}), Picture(50, 40, {1, kInf, 1, 5}),
                                Picture(50, 40, {1, 1, kNan, 5})})
        EXPECT_EQ(test::differentBits(shimmer(picture, heat, kInf, limit(8, picture)), picture.texels), 0u);
}

TEST_F(HeatShimmer, theForegroundDoesNotBleedAndDoesNotMove)
{
    // a red post and a red dot at 2 m, before gas at 5 m, before green ground at 50 m
    Picture picture(80, 60, {0.0f, 1.0f, 0.0f, 1.0f});
    std::vector<float> distances(80 * 60, 50.0f);
    for (int y = 0; y < 60; ++y)
        for (int x = 0; x < 80; ++x) {
            const bool isPost = x >= 36 && x < 44;
            const bool isDot = x == 60 && y == 30;
            if (!isPost && !isDot)
                continue;
            std::fill_n(picture.at(x, y), 2, 0.0f);
            picture.at(x, y)[0] = 1.0f;
            distances[size_t(y * 80 + x)] = 2.0f;
        }
    for (const float offset : {-9.0f, -3.6f, 0.5f, 5.2f}) {
        const auto out =
            shimmer(picture, uniformHeat(picture, offset, 0.3f, 5.0f), distances, limit(10.0f, picture));
        EXPECT_EQ(test::differentBits(out, picture.texels), 0u) << offset;
    }
}

TEST_F(HeatShimmer, manyOverlappingBlobsBendAsOne)
{
    const Picture lines = ramp(80, 60);
    Picture heat(80, 60, {12.0f, 0.0f, 16.0f, 16.0f * 5.0f});
    const auto out = shimmer(lines, heat, kInf, limit(8.0f, lines));
    EXPECT_EQ(pixelOf(out, lines, 40, 30)[0], 43.0f);
}

TEST_F(HeatShimmer, picturesOfOnePixelOrOneLineAreLeftAlone)
{
    for (const auto& [width, height] : {std::pair(1, 1), std::pair(1, 37), std::pair(37, 1), std::pair(2, 2)})
    {
        const Picture picture = noise(width, height, 8);
        const auto out =
            shimmer(picture, uniformHeat(picture, 2.5f, 3.5f, 5.0f), kInf, {.maxOffset = 100.0f});
        EXPECT_EQ(test::differentBits(out, picture.texels), 0u) << width << " x " << height;
    }
}

TEST_F(HeatShimmer, noiseSeenThroughHotBlobsKeepsItsMeanBrightness)
{
    const Picture picture = noise(320, 240, 9);
    std::vector<BlobInstance> blobs;
    for (uint64_t i = 0; i < 40; ++i) {
        const auto u = base::randomUnit4(4, 1, i, base::RandomPurpose::Position);
        BlobInstance blob{};
        blob.centerRadius = {(u[0] - 0.5f) * 8.0f, (u[1] - 0.5f) * 6.0f, -8.0f - u[2], 1.5f};
        blob.medium = {1.0f, 1200.0f, 0.0f, u[3]};
        blobs.push_back(blob);
    }
    CameraView camera;
    camera.projection = glm::perspective(0.9f, 4.0f / 3.0f, 0.1f, 100.0f);
    graph_->begin();
    const std::vector<float> distances(320 * 240, kInf);
    HeatOffsetPass::Inputs offset{};
    offset.blobs = importBytes(std::as_bytes(std::span(blobs)));
    offset.distance = importScalar(320, 240, distances);
    offset.count = 40;
    offset.anyHeat = true;
    offset.width = 320;
    offset.height = 240;
    offset.view = makeViewBlock(camera, 320, 240);
    offset.settings = {.strength = 4.0f, .maxOffset = 30.0f};
    const ResourceId heat = HeatOffsetPass::addTo(*graph_, offset).heat;
    const auto result =
        HeatShimmerPass::addTo(*graph_, {import(picture), offset.distance, heat, wholeOf(320, 240), 320, 240,
                                         false, offset.settings});
    execute(result.color);
    const auto out = read(result.color);

    double before = 0.0;
    double after = 0.0;
    size_t moved = 0;
    for (size_t i = 0; i < out.size(); i += 4) {
        before += picture.texels[i];
        after += out[i];
        moved += out[i] != picture.texels[i] ? 1 : 0;
    }
    EXPECT_GT(moved, out.size() / 4 / 3);
    EXPECT_NEAR(after / before, 1.0, 0.01);
}

TEST(HeatShimmerInTheGraph, isAbsentWithoutHeatOrStrength)
{
    const auto adds = [](bool hot, ShimmerSettings settings, bool anyArea = true) {
        constexpr HotArea kWhole[] = {{0, 0, 16, 16}};
        FrameGraph graph(std::pmr::new_delete_resource());
        graph.begin();
        const ResourceId color = graph.importTexture({"color", 16, 16, Format::RGBA32F}, 1);
        const ResourceId distance = graph.importTexture({"distance", 16, 16, Format::R32F}, 2);
        const ResourceId heat = graph.importTexture({"heat", 16, 16, Format::RGBA32F}, 3);
        const auto out = HeatShimmerPass::addTo(graph, {color, distance, hot ? heat : ResourceId{},
                                                        std::span(kWhole).first(anyArea ? 1 : 0), 16, 16,
                                                        false, settings});
        graph.keep(out.color);
        graph.compile();
        RecordingBackend backend(graph);
        graph.execute(backend);
        EXPECT_TRUE(backend.violations().empty()) << backend.violations().front();
        EXPECT_EQ(graph.executedPasses().empty(), out.color.index == color.index);
        return out.color.index != color.index;
    };
    EXPECT_TRUE(adds(true, {}));
    EXPECT_FALSE(adds(false, {}));
    EXPECT_FALSE(adds(true, {.strength = 0.0f}));
    EXPECT_FALSE(adds(true, {.strength = kNan}));
    EXPECT_FALSE(adds(true, {.maxOffset = 0.0f}));
    EXPECT_FALSE(adds(true, {}, false));
}
