#include "tests/simulation/particles/core/sprites.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>

using namespace fx;
using namespace fx::test;
namespace column = base::particle_column;

namespace {

/// The nearest binary16 by search over all of them; x >= 0.
uint16_t nearestHalf(double x)
{
    const auto valueOf = [](uint32_t h) {
        const int exponent = int(h >> 10);
        const double mantissa = double(h & 1023u) / 1024.0;
        return exponent == 0 ? std::ldexp(mantissa, -14) : std::ldexp(1.0 + mantissa, exponent - 15);
    };
    uint32_t low = 0, high = 0x7BFF;
    while (high - low > 1) {
        const uint32_t middle = (low + high) / 2;
        (valueOf(middle) <= x ? low : high) = middle;
    }
    const double below = x - valueOf(low), above = valueOf(high) - x;
    return uint16_t(below < above || (below == above && low % 2 == 0) ? low : high);
}

double channel(uint64_t color, int c)
{
    const uint32_t h = uint32_t(color >> (16 * c)) & 0xFFFFu;
    const double mantissa = double(h & 1023u) / 1024.0;
    return h >> 10 == 0 ? std::ldexp(mantissa, -14) : std::ldexp(1.0 + mantissa, int(h >> 10) - 15);
}

} // namespace

TEST(AppearanceKernel, colorsAreTheNearestHalfFloats)
{
    for (const float value : {0.0f, 1e-8f, 3e-8f, 5.9604645e-8f, 2.1e-5f, 6.1e-5f, 6.2e-5f, 0.1f, 0.33333334f,
                              1.0f, 1.00048828125f, 1.0014648f, 777.7f, 65504.0f})
    {
        Stage stage;
        auto def = burstEmitter(1);
        def->appearance.kind = sim::AppearanceKind::Sprite;
        def->appearance.colorOverLife = base::ColorCurve(std::array{value, 2.0f * value, 0.5f});
        stage.add({}, std::move(def));
        stage.step();
        const uint64_t color = stage.look().group(0).column64(column::Color)[0];
        EXPECT_EQ(uint16_t(color), nearestHalf(double(value))) << value;
        EXPECT_EQ(uint16_t(color >> 16), nearestHalf(std::min(2.0 * double(value), 65504.0))) << value;
        EXPECT_EQ(uint16_t(color >> 48), nearestHalf(1.0));
    }
}

TEST(AppearanceKernel, sizeColorAndOpacityFollowTheirCurves)
{
    Stage stage;
    auto def = spriteEmitter(500.0f, {1.0f, 2.0f});
    def->radius = {0.1f, 0.1f};
    def->lifetime = {2.0f, 2.0f};
    const std::array<base::CurveKey<3>, 3> keys{
        {{0.0f, {1.0f, 0.5f, 0.0f}}, {0.5f, {0.25f, 1.0f, 4.0f}}, {1.0f, {0.0f, 0.0f, 1.0f}}}};
    def->appearance.colorOverLife = base::ColorCurve(std::span<const base::CurveKey<3>>(keys));
    const std::array<base::CurveKey<1>, 2> grow{{{0.0f, {1.0f}}, {1.0f, {3.0f}}}};
    def->sizeOverLife = base::ScalarCurve(std::span<const base::CurveKey<1>>(grow));
    const base::ColorCurve colors = def->appearance.colorOverLife;
    const base::ScalarCurve sizes = def->sizeOverLife, opacities = def->opacityOverLife;
    stage.add({}, std::move(def));
    stage.play(110);
    const base::SnapshotGroup& group = stage.look().group(0);
    ASSERT_GT(group.count(), 800u);
    for (uint32_t i = 0; i < group.count(); ++i) {
        const float t = group.column(column::Age)[i] / 2.0f;
        const uint64_t color = group.column64(column::Color)[i];
        ASSERT_NEAR(group.column(column::Radius)[i], 0.1f * sizes.at(t)[0], 1e-6f);
        for (int c = 0; c < 3; ++c)
            ASSERT_NEAR(channel(color, c), double(colors.at(t)[size_t(c)]), 2.5e-3) << t;
        ASSERT_NEAR(channel(color, 3), double(opacities.at(t)[0]), 6e-4) << t;
    }
}

TEST(AppearanceKernel, emptyRowsAreZeroThroughoutAndTheLivingKeepTheirs)
{
    Stage stage;
    auto def = spriteEmitter(301.0f, {0.2f, 1.4f});
    def->maxParticles = 700;
    stage.add({}, std::move(def));
    stage.play(30);
    const auto first = stage.look().group(0).column(column::Age);
    std::vector<float> agesBefore(first.begin(), first.end());
    for (int step = 0; step < 200; ++step) {
        stage.step();
        const base::SnapshotGroup& group = stage.look().group(0);
        const auto age = group.column(column::Age);
        const auto radius = group.column(column::Radius);
        for (uint32_t i = 0; i < group.count(); ++i) {
            if (radius[i] == 0.0f) {
                for (const size_t c :
                     {column::PositionX, column::PositionY, column::PositionZ, column::Age, column::Angle})
                    ASSERT_EQ(std::bit_cast<uint32_t>(group.column(c)[i]), 0u);
                ASSERT_EQ(group.column64(column::Color)[i], 0u);
            } else if (age[i] >= 1.0f / 60.0f) { // lived before: in the same row
                ASSERT_LT(i, agesBefore.size());
                ASSERT_NEAR(age[i] - agesBefore[i], 1.0f / 60.0f, 2e-6f);
            }
        }
        agesBefore.assign(age.begin(), age.end());
    }
}

TEST(AppearanceKernel, boundsHoldEverySprite)
{
    Stage stage;
    stage.add({}, spriteEmitter(900.0f, {0.2f, 1.0f}));
    stage.play(100);
    const base::SnapshotGroup& group = stage.look().group(0);
    const base::Bounds& bounds = group.info().bounds;
    float highest = -1e9f;
    for (uint32_t i = 0; i < group.count(); ++i) {
        const float radius = group.column(column::Radius)[i];
        if (radius == 0.0f)
            continue;
        for (size_t a = 0; a < 3; ++a) {
            ASSERT_LE(bounds.min[int(a)], group.column(a)[i] - radius);
            ASSERT_GE(bounds.max[int(a)], group.column(a)[i] + radius);
        }
        highest = std::max(highest, group.column(column::PositionY)[i] + radius);
    }
    EXPECT_NEAR(bounds.max.y, highest, 0.06f); // the largest radius more at most
}

TEST(AppearanceKernel, flipBooksRunOverLifeOrByTheSecond)
{
    for (const bool overLife : {true, false}) {
        Stage stage;
        auto def = burstEmitter(1);
        def->appearance.kind = sim::AppearanceKind::Sprite;
        def->lifetime = {2.0f, 2.0f};
        def->appearance.tileColumns = 4;
        def->appearance.tileRows = 2;
        def->appearance.frames = overLife ? sim::FrameClock::OverLife : sim::FrameClock::PerSecond;
        def->appearance.framesPerSecond = 10.0f;
        stage.add({}, std::move(def));
        stage.play(60);
        EXPECT_NEAR(stage.look().group(0).column(column::Frame)[0], overLife ? 4.0f : 2.0f, 1e-4f);
    }
}
