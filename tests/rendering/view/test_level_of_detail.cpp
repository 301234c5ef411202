// What is left out of a far effect, and that what remains stands for all of it. No GL.
#include "rendering/lod/level_of_detail.h"
#include "rendering/stage/stage_camera.h"

#include <glm/gtc/quaternion.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

using namespace fx;
using render::LodRamp;

namespace {

constexpr double kPi = std::numbers::pi;

/// Worst difference of the number of ranks below a share from that share, over runs of `count` numbers.
template <class Rank>
double worstCount(uint64_t stride, uint64_t count, Rank rank)
{
    double worst = 0.0;
    for (uint64_t run = 0; run < 50; ++run)
        for (const float share : {0.03f, 0.125f, 0.3f, 0.5f, 0.8f}) {
            double below = 0.0;
            for (uint64_t i = 0; i < count; ++i)
                below += rank(run * 104'729 + i * stride) < share ? 1.0 : 0.0;
            worst = std::max(worst, std::abs(below - double(share) * double(count)));
        }
    return worst;
}

float randomRank(uint64_t id)
{
    uint64_t x = (id + 1) * 0x9E3779B97F4A7C15u;
    x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9u;
    x = (x ^ (x >> 27)) * 0x94D049BB133111EBu;
    return float((x ^ (x >> 31)) >> 40) * 0x1.0p-24f;
}

base::GroupInfo ballOf(float radius, uint32_t count)
{
    base::GroupInfo info;
    info.instance = 7;
    info.count = count;
    const float half = radius / std::sqrt(3.0f);
    info.bounds.min = glm::vec3(-half);
    info.bounds.max = glm::vec3(half);
    return info;
}

class LevelOfDetailTest : public testing::Test
{
protected:
    render::LodLevel at(float distance, float bias = 4.0f, bool forget = false)
    {
        const auto camera =
            render::cameraGeometry(render::perspectiveView({{0, 0, 0}, {0, 0, -1}}, 1.0f, 1.0f, 0.1f));
        lod_.begin({bias}, camera, 720, forget);
        base::Placement place;
        place.position = {0, 0, -distance};
        return lod_.levelOf(ballOf(1.0f, 1000), place);
    }

    render::LevelOfDetail lod_{std::pmr::get_default_resource()};
};

} // namespace

TEST(BirthRank, ofAnyRunOfBirthsAboutTheShareIsBelowIt)
{
    EXPECT_LT(worstCount(1, 64, render::birthRank), 5.0);
    EXPECT_LT(worstCount(1, 4096, render::birthRank), 12.0);
    EXPECT_GT(worstCount(1, 4096, randomRank), 50.0) << "random numbers are far worse, or this shows nothing";
}

TEST(BirthRank, everySecondThirdAndFourthBirthIsThinnedOutAlike)
{
    for (const uint64_t stride : {2u, 3u, 4u, 5u, 8u})
        EXPECT_LT(worstCount(stride, 4096, render::birthRank), 60.0) << stride;
}

TEST(LodRamp, theMeanOfAllWeightsIsWhatItSays)
{
    for (const float share : {1e-3f, 0.01f, 0.1f, 0.5f, 0.79f, 0.8f, 0.81f, 1.0f, 1.2f, 1.33f, 1.34f, 50.0f})
    {
        const LodRamp ramp(share);
        constexpr int kRanks = 1 << 20;
        double sum = 0.0;
        for (int i = 0; i < kRanks; ++i)
            sum += double(ramp.weight(float((double(i) + 0.5) / kRanks)));
        EXPECT_NEAR(sum / kRanks, double(ramp.mean()), 0x1.0p-22) << share;
    }
}

TEST(LodRamp, aboveAllEverythingIsDrawnUnchanged)
{
    EXPECT_TRUE(LodRamp(LodRamp::kAll).isAll());
    EXPECT_EQ(LodRamp(LodRamp::kAll).weight(0.9999999f), 1.0f);
    EXPECT_FALSE(LodRamp(std::nextafter(LodRamp::kAll, 0.0f)).mean() > 1.0f);
}

TEST(LodRamp, aParticleOnceLeftOutStaysOutWhileTheShareFalls)
{
    for (float rank = 0.0f; rank < 1.0f; rank += 0.01f) {
        float before = 1.0f;
        for (float share = LodRamp::kAll; share > 0.001f; share *= 0.98f) {
            const float weight = LodRamp(share).weight(rank);
            ASSERT_LE(weight, before);
            ASSERT_LT(before - weight, 0.05f) << "it fades, it does not jump";
            before = weight;
        }
    }
}

/// Optical depth along rays through a disc in which blobs are strewn at random: mean and variance over rays,
/// of all blobs and of those that are kept.
TEST(LodRamp, theKeptOnesHaveTheOpticalDepthOfAllInMeanAndInVariance)
{
    constexpr int kBlobs = 100'000;
    constexpr double kSide = 100.0, kRadius = 0.5, kCross = 0.1;
    std::mt19937 random(5);
    std::uniform_real_distribution<double> place(0.0, kSide);
    std::vector<std::pair<double, double>> centers(kBlobs);
    for (auto& center : centers)
        center = {place(random), place(random)};
    const auto moments = [&](const LodRamp& ramp, bool grows) {
        const double radius = grows ? kRadius / std::sqrt(double(ramp.mean())) : kRadius;
        constexpr int kRays = 200; // along each side
        std::vector<double> depth(size_t(kRays) * kRays, 0.0);
        for (size_t i = 0; i < centers.size(); ++i) {
            const double tau =
                kCross * double(ramp.weight(render::birthRank(i)) / ramp.mean()) / (kPi * radius * radius);
            const double step = kSide / kRays;
            const auto [x, y] = centers[i];
            for (int a = int((x - radius) / step); a <= int((x + radius) / step); ++a)
                for (int b = int((y - radius) / step); b <= int((y + radius) / step); ++b)
                    if (std::hypot((a + 0.5) * step - x, (b + 0.5) * step - y) < radius)
                        depth[size_t((b + kRays) % kRays) * kRays + size_t((a + kRays) % kRays)] += tau;
        }
        double mean = 0.0, square = 0.0;
        for (const double tau : depth) {
            mean += tau / double(depth.size());
            square += tau * tau / double(depth.size());
        }
        return std::pair(mean, square - mean * mean);
    };
    const auto [meanAll, varianceAll] = moments(LodRamp(), true);
    EXPECT_NEAR(meanAll, kBlobs * kCross / (kSide * kSide), 0.01 * meanAll);
    for (const float share : {0.5f, 0.1f}) {
        const auto [mean, variance] = moments(LodRamp(share), true);
        EXPECT_NEAR(mean / meanAll, 1.0, 0.01) << share;
        EXPECT_NEAR(variance / varianceAll, 1.0, 0.25)
            << share; // the border's weights add 1/25, rays the rest
        EXPECT_GT(moments(LodRamp(share), false).second / varianceAll, 1.6)
            << "without growing it is lumpier";
    }
}

TEST_F(LevelOfDetailTest, withoutBiasEverythingIsDrawn)
{
    EXPECT_TRUE(at(1e6f, 0.0f).ramp.isAll());
    EXPECT_EQ(lod_.counts()[0], 1u);
}

TEST_F(LevelOfDetailTest, keepsOneBlobForAsManyPixelsAsTheBiasSays)
{
    // the half angle of the view is 0.5: 360 pixels are tan 0.5 = 0.5463
    const double pixels = 360.0 / std::tan(0.5) / 100.0; // radius of a ball of 1 m at 100 m
    EXPECT_NEAR(double(at(100.0f, 4.0f).ramp.mean()), kPi * pixels * pixels / 4.0 / 1000.0, 1e-3);
    EXPECT_NEAR(double(at(1e5f, 4.0f, true).ramp.mean()), 0.012, 1e-4) << "twelve remain";
    EXPECT_TRUE(at(0.5f).ramp.isAll()) << "from inside";
}

TEST_F(LevelOfDetailTest, fliesInWithoutAJumpAndIgnoresATremblingCamera)
{
    float before = at(400.0f).ramp.mean();
    for (float distance = 400.0f; distance > 5.0f; distance *= 0.995f) {
        const float now = at(distance).ramp.mean();
        ASSERT_LT(std::abs(now - before), 0.02f * now) << distance;
        before = now;
    }
    (void)at(100.0f, 4.0f, true);
    const float still = at(100.0f).ramp.mean();
    for (const float distance : {101.0f, 99.0f, 103.0f, 97.0f})
        EXPECT_EQ(at(distance).ramp.mean(), still) << distance;
    EXPECT_NE(at(99.0f, 4.0f, true).ramp.mean(), still) << "after a cut of the camera it begins anew";
}

TEST_F(LevelOfDetailTest, aGroupWithoutBoundsIsDrawnInFull)
{
    (void)at(1000.0f);
    base::GroupInfo unknown = ballOf(1.0f, 1000);
    unknown.bounds = {};
    EXPECT_TRUE(lod_.levelOf(unknown, {}).ramp.isAll());
}
