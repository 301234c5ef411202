// What is left out of far sprites, meshes and ribbons, and that what remains stands for all of it. No GL.
#include "foundation/snapshot/particle_kind.h"
#include "rendering/lod/stochastic_simplification.h"
#include "rendering/stage/stage_camera.h"

#include <glm/gtc/quaternion.hpp>
#include <glm/packing.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

using namespace fx;
using render::LodRamp;
using render::RowShape;
namespace column = base::particle_column;

namespace {

constexpr float kUnlimited = 1e9f;

render::LodLevel levelOf(float share, float grownPixels = kUnlimited)
{
    render::LodLevel level;
    level.ramp = LodRamp(share);
    level.grownPixels = level.swollenPixels = grownPixels;
    return level;
}

/// Mean over all ranks of the area times the opacity that is drawn, in units of what it is without.
double meanCover(const render::LodLevel& level, RowShape shape, float pixels = 1.0f)
{
    const bool isStrip = shape == RowShape::Strip || shape == RowShape::SolidStrip;
    constexpr int kRanks = 1 << 16;
    double sum = 0.0;
    for (int i = 0; i < kRanks; ++i) {
        const render::RowFactors factors =
            render::rowFactors(level, (float(i) + 0.5f) / float(kRanks), pixels, shape);
        const double size = double(factors.size);
        sum += (isStrip ? size : size * size) * double(factors.opacity);
    }
    return sum / kRanks;
}

class StochasticSimplification : public testing::Test
{
protected:
    StochasticSimplification()
    {
        particles_ = schema_.add(base::kParticleKind), ribbons_ = schema_.add(base::kRibbonKind);
    }

    static base::GroupInfo ball(uint64_t instance, uint32_t count)
    {
        base::GroupInfo info;
        info.instance = instance;
        info.count = count;
        info.bounds.min = glm::vec3(-1.0f);
        info.bounds.max = glm::vec3(1.0f);
        return info;
    }
    base::SnapshotGroup& addRows(base::FrameSnapshot& snapshot, uint32_t count)
    {
        auto& group = snapshot.addGroup(particles_, count, column::kAlways);
        group.editInfo() = ball(1, count);
        group.editInfo().kind = particles_;
        for (uint32_t i = 0; i < count; ++i)
            group.editColumn(column::Radius)[i] = 0.01f;
        return group;
    }
    /// Strips of five points, the newest first.
    base::SnapshotGroup& addStrips(base::FrameSnapshot& snapshot, uint32_t first, uint32_t count,
                                   uint64_t more = 0)
    {
        auto& group = snapshot.addGroup(ribbons_, 5 * count);
        group.editInfo() = ball(1, 5 * count);
        group.editInfo().kind = ribbons_;
        for (uint32_t i = 0; i < 5 * count; ++i) {
            group.editColumn64(base::ribbon_column::Strip)[i] = (first + i / 5) ^ more;
            group.editColumn(base::ribbon_column::HalfWidth)[i] = 0.01f;
        }
        return group;
    }
    bool thin(const base::SnapshotGroup& group, float bias, RowShape shape, float distance = 100.0f,
              std::span<const render::RowPart> parts = {})
    {
        const auto camera =
            render::cameraGeometry(render::perspectiveView({{0, 0, 0}, {0, 0, -1}}, 1.0f, 1.0f, 0.1f));
        render::LodSettings settings;
        settings.bias = bias;
        lod_.begin(settings, camera, 720, true);
        base::Placement place;
        place.position = {0, 0, -distance};
        leftOut_ = 0;
        return render::simplifyRows({&group, parts, place, shape, &camera, 659.0f}, lod_, factors_, leftOut_);
    }
    size_t kept() const { return factors_.size() - size_t(std::count(factors_.begin(), factors_.end(), 0u)); }

    base::SnapshotSchema schema_;
    base::KindId particles_ = 0, ribbons_ = 0;
    render::LevelOfDetail lod_{std::pmr::get_default_resource()};
    std::pmr::vector<uint32_t> factors_;
    uint64_t leftOut_ = 0;
};

} // namespace

TEST(RowFactors, coverIsKeptOnAverageForAllShapes)
{
    for (const float share : {0.01f, 0.1f, 0.5f, 0.9f, 1.2f})
        for (const RowShape shape : {RowShape::Card, RowShape::Body, RowShape::Strip, RowShape::SolidStrip})
            EXPECT_NEAR(meanCover(levelOf(share), shape), 1.0, 1e-3) << share << " " << int(shape);
}

TEST(RowFactors, whereGrowthIsLimitedOpacityMakesUpForIt)
{
    for (const float grown : {0.5f, 1.0f, 2.0f, 5.0f})
        for (const RowShape shape : {RowShape::Card, RowShape::Strip})
            EXPECT_NEAR(meanCover(levelOf(0.05f, grown), shape), 1.0, 1e-3) << grown << " " << int(shape);
    EXPECT_LT(meanCover(levelOf(0.05f, 2.0f), RowShape::Body), 0.5) << "what hides cannot";
    const render::RowFactors factors = render::rowFactors(levelOf(0.05f, 2.0f), 0.0f, 1.0f, RowShape::Card);
    EXPECT_EQ(factors.size, 2.0f) << "the limit";
    EXPECT_EQ(render::rowFactors(levelOf(0.05f, 2.0f), 0.0f, 3.0f, RowShape::Card).size, 1.0f)
        << "what is larger than the limit does not grow";
}

TEST(RowFactors, whatHasGoneStaysAwayWhileTheShareFallsAndFadesBefore)
{
    for (const RowShape shape : {RowShape::Card, RowShape::Body, RowShape::Strip})
        for (float rank = 0.005f; rank < 1.0f; rank += 0.01f) {
            double before = 1.0;
            for (float share = LodRamp::kAll; share > 0.02f; share *= 0.98f) {
                const render::LodLevel level = levelOf(share);
                const render::RowFactors factors = render::rowFactors(level, rank, 1.0f, shape);
                const double area =
                    double(shape == RowShape::Strip ? factors.size : factors.size * factors.size);
                const double cover =
                    area * double(factors.opacity * level.ramp.mean()); // one that is sure: 1
                ASSERT_LT(before - cover, 0.05) << "it fades, it does not jump";
                ASSERT_LT(cover - before, 1e-4) << "and does not come back";
                before = cover;
            }
        }
}

/// Rays through cards that are strewn at random: mean and variance of the light that passes.
TEST(RowFactors, theKeptOnesLetAsMuchLightPassAsAllInMeanAndInVariance)
{
    constexpr int kCards = 60'000;
    constexpr double kSide = 60.0, kHalf = 0.15, kOpacity = 0.3;
    std::mt19937 random(7);
    std::uniform_real_distribution<double> place(0.0, kSide);
    std::vector<std::pair<double, double>> centers(kCards);
    for (auto& center : centers)
        center = {place(random), place(random)};
    const auto moments = [&](float share, bool compensates) {
        constexpr int kRays = 300; // along each side
        std::vector<double> passes(size_t(kRays) * kRays, 1.0);
        for (size_t i = 0; i < centers.size(); ++i) {
            render::RowFactors factors =
                render::rowFactors(levelOf(share), render::birthRank(i), 1.0f, RowShape::Card);
            if (!compensates)
                factors = {1.0f, factors.opacity > 0.0f ? 1.0f : 0.0f};
            const double half = kHalf * double(factors.size), step = kSide / kRays;
            const auto [x, y] = centers[i];
            for (int a = int(std::ceil((x - half) / step - 0.5)); (a + 0.5) * step < x + half; ++a)
                for (int b = int(std::ceil((y - half) / step - 0.5)); (b + 0.5) * step < y + half; ++b)
                    passes[size_t((b + kRays) % kRays) * kRays + size_t((a + kRays) % kRays)] *=
                        1.0 - kOpacity * double(factors.opacity);
        }
        double mean = 0.0, square = 0.0;
        for (const double t : passes) {
            mean += t / double(passes.size());
            square += t * t / double(passes.size());
        }
        return std::pair(mean, square - mean * mean);
    };
    const double cover = kCards * 4.0 * kHalf * kHalf / (kSide * kSide);
    const auto [meanAll, varianceAll] = moments(100.0f, true);
    EXPECT_NEAR(meanAll, std::exp(-kOpacity * cover), 0.01);
    for (const float share : {0.5f, 0.1f}) {
        const auto [mean, variance] = moments(share, true);
        EXPECT_NEAR(mean, meanAll, 0.015) << share;
        EXPECT_NEAR(variance / varianceAll, 1.0, 0.15) << share;
        EXPECT_GT(moments(share, false).first, meanAll + 0.1) << "without compensation more light passes";
    }
}

TEST_F(StochasticSimplification, isNothingWithoutBiasAndFromNear)
{
    base::FrameSnapshot snapshot(&schema_, std::pmr::get_default_resource());
    const auto& group = addRows(snapshot, 1000);
    EXPECT_FALSE(thin(group, 0.0f, RowShape::Card));
    EXPECT_FALSE(thin(group, 4.0f, RowShape::Card, 3.0f));
    EXPECT_EQ(leftOut_, 0u);
    EXPECT_TRUE(thin(group, 4.0f, RowShape::Card));
    EXPECT_EQ(kept() + leftOut_, 1000u);
    EXPECT_GT(leftOut_, 500u);
}

TEST_F(StochasticSimplification, emptyRowsDoNotCount)
{
    base::FrameSnapshot snapshot(&schema_, std::pmr::get_default_resource());
    auto& group = addRows(snapshot, 4000);
    for (uint32_t i = 40; i < 4000; ++i)
        group.editColumn(column::Radius)[i] = 0.0f;
    EXPECT_FALSE(thin(group, 4.0f, RowShape::Card)) << "forty that live are few enough";
}

TEST_F(StochasticSimplification, keepsPartOfWhatItKeepsFromNearer)
{
    base::FrameSnapshot snapshot(&schema_, std::pmr::get_default_resource());
    const auto& group = addRows(snapshot, 3000);
    ASSERT_TRUE(thin(group, 4.0f, RowShape::Card, 60.0f));
    auto before = factors_;
    for (float distance = 70.0f; distance < 600.0f; distance *= 1.1f) {
        ASSERT_TRUE(thin(group, 4.0f, RowShape::Card, distance));
        for (size_t i = 0; i < factors_.size(); ++i)
            ASSERT_FALSE(before[i] == 0 && factors_[i] != 0) << i;
        before = factors_;
    }
}

TEST_F(StochasticSimplification, anEffectKeepsTheSameRowsWhoeverItIsMergedWith)
{
    base::FrameSnapshot snapshot(&schema_, std::pmr::get_default_resource());
    const auto& alone = addRows(snapshot, 600);
    ASSERT_TRUE(thin(alone, 16.0f, RowShape::Card));
    const auto wanted = factors_;
    auto& merged = addRows(snapshot, 1900);
    std::vector<render::RowPart> parts{{ball(2, 1300), 0, 1300}, {ball(1, 600), 1300, 600}};
    parts[0].info.placement.position = {0, 0, -2.0}; // so near that all of it is drawn
    parts[1].info.placement.position = {0, 0, -100.0};
    ASSERT_TRUE(thin(merged, 16.0f, RowShape::Card, 0.0f, parts));
    const uint32_t unchanged = glm::packHalf2x16({1.0f, 1.0f});
    EXPECT_EQ(std::count(factors_.begin(), factors_.begin() + 1300, unchanged), 1300);
    EXPECT_TRUE(std::equal(wanted.begin(), wanted.end(), factors_.begin() + 1300));
}

TEST_F(StochasticSimplification, aStripStaysOrGoesAsAWholeWhereverItsRowsAre)
{
    base::FrameSnapshot snapshot(&schema_, std::pmr::get_default_resource());
    ASSERT_TRUE(thin(addStrips(snapshot, 100, 200), 16.0f, RowShape::Strip));
    const auto before = factors_;
    for (size_t i = 0; i < before.size(); ++i) {
        EXPECT_EQ(before[i], i % 5 == 4 ? 0u : before[i / 5 * 5]) << i;
        EXPECT_TRUE(i % 5 == 4 || before[i] == 0 || kept() > 0);
    }
    EXPECT_EQ(kept() + leftOut_, 800u);
    ASSERT_TRUE(thin(addStrips(snapshot, 90, 200, uint64_t(9) << 40), 16.0f, RowShape::Strip));
    for (size_t i = 0; i + 50 < before.size(); ++i)
        ASSERT_EQ(factors_[i + 50], before[i])
            << "ten older strips more, and another number in a merged group";
}
