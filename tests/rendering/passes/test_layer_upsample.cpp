// Small layers brought to the picture's size: what must come through unchanged, and whose light a surface may
// never get.
#include "foundation/random/philox.h"
#include "rendering/passes/layer_distance_pass.h"
#include "rendering/passes/layer_upsample_pass.h"
#include "tests/rendering/passes/post_pass_harness.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace {

using namespace fx;
using namespace fx::render;
using test::Picture;

constexpr int kWidth = 47, kHeight = 30; // blocks at two borders are incomplete
constexpr float kSky = std::numeric_limits<float>::infinity();

float unit(uint64_t seed, uint64_t i)
{
    return base::randomUnit4(seed, 0, i, base::RandomPurpose::Noise)[0];
}

/// [m] surfaces of every kind: steps, slopes, single pixels and sky.
std::vector<float> roughScene()
{
    std::vector<float> distance;
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
            const float u = unit(1, uint64_t(y * kWidth + x));
            const float slope = 8.0f + 0.1f * float(y);
            distance.push_back(x % 11 == 3 ? 2.0f
                                           : (u > 0.98f ? kSky : (u > 0.96f ? 1.0f + 9.0f * u : slope)));
        }
    return distance;
}

class LayerUpsample : public test::PostPass
{
protected:
    struct Ends
    {
        std::vector<float> far, near;
        int width, height;
    };

    Ends reduce(const std::vector<float>& distance, int divisor)
    {
        graph_->begin();
        const auto out = addDistance(importScalar(kWidth, kHeight, distance), divisor);
        graph_->keep(out.near);
        execute(out.far);
        return {read(out.far, 1), read(out.near, 1), layerWidth(divisor), layerHeight(divisor)};
    }

    /// @param farLight, nearLight of the layers' size
    std::vector<float> enlarge(const std::vector<float>& distance, const Picture& farLight,
                               const Picture& nearLight, int divisor)
    {
        graph_->begin();
        const ResourceId scene = importScalar(kWidth, kHeight, distance);
        const auto ends = addDistance(scene, divisor);
        const ResourceId light =
            LayerUpsamplePass::addTo(*graph_,
                                     {scene, ends.far, ends.near, import(farLight), import(nearLight), kWidth,
                                      kHeight, divisor, Format::RGBA32F, "light"})
                .light;
        execute(light);
        return read(light);
    }

    static int layerWidth(int divisor) { return (kWidth + divisor - 1) / divisor; }
    static int layerHeight(int divisor) { return (kHeight + divisor - 1) / divisor; }
    static Picture even(int divisor, std::array<float, 4> value)
    {
        return Picture(layerWidth(divisor), layerHeight(divisor), value);
    }

private:
    LayerDistancePass::Outputs addDistance(ResourceId scene, int divisor)
    {
        return LayerDistancePass::addTo(*graph_,
                                        {scene, true, layerWidth(divisor), layerHeight(divisor), divisor});
    }
};

} // namespace

TEST_F(LayerUpsample, keepsBothEndsOfEachBlock)
{
    const std::vector<float> scene = roughScene();
    for (const int divisor : {2, 4}) {
        const Ends ends = reduce(scene, divisor);
        int flat = 0, split = 0;
        for (int by = 0; by < ends.height; ++by)
            for (int bx = 0; bx < ends.width; ++bx) {
                float low = kSky, high = 0.0f;
                for (int y = by * divisor; y < std::min((by + 1) * divisor, kHeight); ++y)
                    for (int x = bx * divisor; x < std::min((bx + 1) * divisor, kWidth); ++x) {
                        low = std::min(low, scene[size_t(y * kWidth + x)]);
                        high = std::max(high, scene[size_t(y * kWidth + x)]);
                    }
                const size_t i = size_t(by * ends.width + bx);
                if (low == high || low >= (1.0f - kFlatBlock) * high) { // one surface, maybe a neighbor's too
                    const bool isFar = low <= ends.far[i] && ends.far[i] <= high;
                    const bool isNear = low <= ends.near[i] && ends.near[i] <= high;
                    EXPECT_TRUE(isFar || isNear);
                    EXPECT_TRUE(isFar || ends.far[i] > high);
                    EXPECT_TRUE(isNear || ends.near[i] < low);
                    ++flat;
                } else {
                    EXPECT_EQ(ends.near[i], low);
                    EXPECT_EQ(ends.far[i], high);
                    ++split;
                }
            }
        EXPECT_GT(flat, 5) << divisor;
        EXPECT_GT(split, 5) << divisor;
    }
}

TEST_F(LayerUpsample, reproducesAnEvenMediumBitForBit)
{
    const std::array<float, 4> value{0.1f, 0.7f, 1.3e-5f, 0.9f};
    for (const int divisor : {2, 4}) {
        const auto light = enlarge(roughScene(), even(divisor, value), even(divisor, value), divisor);
        for (size_t i = 0; i < light.size(); ++i)
            ASSERT_EQ(light[i], value[i % 4]);
    }
}

TEST_F(LayerUpsample, givesNoSurfaceTheLightOfAnother)
{
    // A thin pillar at 2 m before sky: media end at it, or go on behind.
    std::vector<float> scene(size_t(kWidth) * kHeight, kSky);
    for (int y = 0; y < kHeight; ++y)
        for (const int x : {9, 22, 23, 30, 31, 32, 33, 34, 35, 36, 37, 38})
            scene[size_t(y * kWidth + x)] = 2.0f;
    for (const int divisor : {2, 4}) {
        const Ends ends = reduce(scene, divisor);
        Picture farLight = even(divisor, {1.0f, 1.0f, 1.0f, 1.0f});
        for (size_t i = 0; i < ends.far.size(); ++i)
            if (ends.far[i] == 2.0f) // wholly on the pillar
                std::fill_n(farLight.texels.begin() + std::ptrdiff_t(4 * i), 4, 0.25f);
        const auto light = enlarge(scene, farLight, even(divisor, {0.25f, 0.25f, 0.25f, 0.25f}), divisor);
        for (size_t i = 0; i < scene.size(); ++i)
            ASSERT_EQ(light[4 * i], scene[i] == 2.0f ? 0.25f : 1.0f) << i % kWidth << " 1/" << divisor;
    }
}

TEST_F(LayerUpsample, interpolatesLinearlyOnOneSurface)
{
    const std::vector<float> wall(size_t(kWidth) * kHeight, 5.0f);
    for (const int divisor : {2, 4}) {
        Picture ramp = even(divisor, {});
        for (int y = 0; y < ramp.height; ++y)
            for (int x = 0; x < ramp.width; ++x)
                *ramp.at(x, y) = 3.0f * (float(x) + 0.5f) - 2.0f * (float(y) + 0.5f);
        const auto light = enlarge(wall, ramp, even(divisor, {}), divisor);
        for (int y = divisor; y < kHeight - divisor; ++y)
            for (int x = divisor; x < kWidth - divisor; ++x)
                ASSERT_NEAR(light[size_t(4 * (y * kWidth + x))],
                            (3.0f * (float(x) + 0.5f) - 2.0f * (float(y) + 0.5f)) / float(divisor), 1e-4f);
    }
}

TEST_F(LayerUpsample, refusesANeighborThatSawOtherSurfacesOnly)
{
    // 2 m up to a block's border, then a block that holds 5 m and 10 m, then 10 m.
    for (const int divisor : {2, 4}) {
        std::vector<float> scene;
        for (int i = 0; i < kWidth * kHeight; ++i) {
            const int x = i % kWidth;
            scene.push_back(x < 8 ? 2.0f : (x < 8 + divisor / 2 ? 5.0f : 10.0f));
        }
        Picture nearLight = even(divisor, {1.0f, 1.0f, 1.0f, 1.0f});
        for (int y = 0; y < nearLight.height; ++y)
            for (int x = 0; x < 8 / divisor; ++x)
                std::fill_n(nearLight.at(x, y), 4, 0.25f);
        Picture farLight = even(divisor, {1.0f, 1.0f, 1.0f, 1.0f});
        for (int y = 0; y < farLight.height; ++y)
            for (int x = 0; x < 8 / divisor - 1; ++x) // the last before the border ends at 10 m, too
                std::fill_n(farLight.at(x, y), 4, 0.25f);
        const auto light = enlarge(scene, farLight, nearLight, divisor);
        for (size_t i = 0; i < scene.size(); ++i)
            if (scene[i] == 2.0f) {
                ASSERT_EQ(light[4 * i], 0.25f) << i % kWidth << " 1/" << divisor;
            }
    }
}
