// Builders of natural forms: what their lumps have in common with the forms.
#include "simulation/blocks/block_builders.h"
#include "simulation/blocks/block_noise.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace fx;

namespace {

sim::BlockBuild buildOf(sim::BlockForm form)
{
    sim::BlockBuild build;
    build.form = form;
    build.count = 2000;
    build.size = {20, 12, 16};
    build.noise = 0.2f;
    return build;
}

/// Mean distance from the axis of the lumps within a range of heights.
double meanWidth(const std::vector<sim::BlockLump>& lumps, float low, float high)
{
    double sum = 0, count = 0;
    for (const sim::BlockLump& lump : lumps)
        if (lump.position.y >= low && lump.position.y < high) {
            sum += double(std::hypot(lump.position.x, lump.position.z));
            count += 1.0;
        }
    return count > 0 ? sum / count : 0.0;
}

constexpr sim::BlockForm kForms[] = {sim::BlockForm::Cloud, sim::BlockForm::Plume, sim::BlockForm::DustWall,
                                     sim::BlockForm::Nebula};

} // namespace

TEST(BlockBuilders, equalSettingsGiveEqualLumpsAndSeedsDiffer)
{
    for (const sim::BlockForm form : kForms) {
        sim::BlockBuild build = buildOf(form);
        const auto a = sim::buildLumps(build), b = sim::buildLumps(build);
        ASSERT_EQ(a.size(), b.size());
        ASSERT_GT(a.size(), 100u) << int(form);
        for (size_t i = 0; i < a.size(); ++i)
            EXPECT_EQ(a[i].position, b[i].position);
        build.seed = 2;
        EXPECT_NE(sim::buildLumps(build)[0].position, a[0].position);
    }
}

TEST(BlockBuilders, lumpsHaveTheirRadiiAndLieWithinTheForm)
{
    for (const sim::BlockForm form : kForms) {
        const sim::BlockBuild build = buildOf(form);
        for (const sim::BlockLump& lump : sim::buildLumps(build)) {
            EXPECT_GE(lump.radius, 0.8f * build.smallest);
            EXPECT_LE(lump.radius, 1.2f * build.largest);
            for (int k = 0; k < 3; ++k)
                EXPECT_LE(std::abs(lump.position[k]), build.size[k] * (k == 1 ? 1.2f : 0.6f)) << int(form);
            if (form != sim::BlockForm::Nebula) {
                EXPECT_GE(lump.position.y, 0.0f);
            }
        }
    }
}

TEST(BlockBuilders, smallLumpsAreMoreByThePowerOfTheirRadius)
{
    for (const sim::BlockForm form : kForms) {
        sim::BlockBuild build = buildOf(form);
        build.count = 20000;
        build.smallest = 0.5f;
        build.largest = 2.0f;
        const auto radiusOf = [&](const sim::BlockLump& lump) {
            return build.smallest + (build.largest - build.smallest) * std::min(2.0f * lump.depth, 1.0f);
        };
        constexpr double kExponent = 2.5;
        double all = 0.0, large = 0.0; // what is to be of an even filling
        for (const sim::BlockLump& lump : sim::buildLumps(build)) {
            const double weight = std::pow(double(radiusOf(lump)), -kExponent);
            all += weight;
            large += radiusOf(lump) > 1.0f ? weight : 0.0;
        }
        build.radiusExponent = float(kExponent);
        const auto lumps = sim::buildLumps(build);
        const auto count =
            std::ranges::count_if(lumps, [&](const auto& lump) { return radiusOf(lump) > 1.0f; });
        ASSERT_GT(lumps.size(), 1000u);
        EXPECT_NEAR(double(count) / double(lumps.size()), large / all, 0.02) << int(form);
    }
}

TEST(BlockBuilders, theBaseOfACloudIsFlat)
{
    sim::BlockBuild build = buildOf(sim::BlockForm::Cloud);
    build.base = 0.25f;
    build.radiusExponent = 0.5f;
    float lowest = 1e9f, reach = 1e9f;
    for (const sim::BlockLump& lump : sim::buildLumps(build)) {
        lowest = std::min(lowest, lump.position.y);
        const float varied = 0.2f * (build.smallest + lump.position.y - 3.0f); // of radii
        reach = std::min(reach, lump.position.y - lump.radius + varied);
    }
    EXPECT_GE(lowest, 3.0f);
    EXPECT_LE(lowest, 3.1f);
    EXPECT_GE(reach, 3.0f - build.smallest - 1e-5f);
}

TEST(BlockBuilders, anAnvilSpreadsTheTop)
{
    sim::BlockBuild build = buildOf(sim::BlockForm::Cloud);
    const double narrow = meanWidth(sim::buildLumps(build), 9.5f, 12.0f);
    build.anvil = 1.0f;
    EXPECT_GT(meanWidth(sim::buildLumps(build), 9.5f, 12.0f), 2.0 * narrow);
}

TEST(BlockBuilders, aPlumeWidensAndLeans)
{
    sim::BlockBuild build = buildOf(sim::BlockForm::Plume);
    const auto upright = sim::buildLumps(build);
    EXPECT_GT(meanWidth(upright, 8.0f, 10.0f), 1.3 * meanWidth(upright, 0.0f, 2.0f));
    build.lean = 10.0f;
    double x = 0, count = 0;
    for (const sim::BlockLump& lump : sim::buildLumps(build))
        if (lump.position.y > 8.0f && lump.position.y < 10.0f) {
            x += double(lump.position.x);
            count += 1.0;
        }
    EXPECT_NEAR(x / count, 10.0 * 0.75 * 0.75, 1.0); // as the square of the height
}

TEST(BlockBuilders, aWallOfDustIsSteepInFrontAndSlopesBehind)
{
    const auto lumps = sim::buildLumps(buildOf(sim::BlockForm::DustWall));
    const auto highest = [&](float low, float high) {
        float most = 0.0f;
        for (const sim::BlockLump& lump : lumps)
            if (lump.position.z >= low && lump.position.z < high)
                most = std::max(most, lump.position.y);
        return most;
    };
    EXPECT_GT(highest(3.0f, 5.0f), 1.5f * highest(-7.0f, -5.0f));
}

TEST(BlockBuilders, moreTowersFillMoreOfTheWidth)
{
    sim::BlockBuild build = buildOf(sim::BlockForm::Cloud);
    build.towers = 1;
    const double one = meanWidth(sim::buildLumps(build), 4.0f, 7.0f);
    build.towers = 20;
    EXPECT_GT(meanWidth(sim::buildLumps(build), 4.0f, 7.0f), 1.5 * one);
}

TEST(BlockNoise, isContinuousAndBalanced)
{
    const sim::BlockNoise noise(3, 2.0f, 3);
    double sum = 0, most = 0;
    for (int i = 0; i < 20000; ++i) {
        const glm::vec3 p(float(i) * 0.37f, float(i % 171) * 0.73f, float(i % 37) * 1.1f - 500.0f);
        const float value = noise.at(p);
        EXPECT_LE(std::abs(value), 1.0f);
        sum += double(value);
        most = std::max(most, double(std::abs(noise.at(p + glm::vec3(1e-3f, 0, 0)) - value)));
    }
    EXPECT_NEAR(sum / 20000, 0.0, 0.02);
    EXPECT_LE(most, 0.02);
}
