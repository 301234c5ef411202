#include "foundation/math/curve.h"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

using namespace fx::base;

namespace {
float at(const ScalarCurve& curve, float t)
{
    return curve.at(t)[0];
}
} // namespace

TEST(Curve, aConstantIsTheSameEverywhere)
{
    const ScalarCurve curve(std::array{3.5f});
    for (const float t : {0.0f, 0.3f, 1.0f})
        EXPECT_EQ(at(curve, t), 3.5f);
}

TEST(Curve, aStraightLineIsExactAtEverySample)
{
    const std::vector<CurveKey<1>> keys{{0.0f, {1.0f}}, {1.0f, {3.0f}}};
    const ScalarCurve curve{std::span<const CurveKey<1>>(keys)};
    for (int i = 0; i <= 64; ++i)
        EXPECT_FLOAT_EQ(at(curve, float(i) / 64.0f), 1.0f + float(i) / 32.0f);
    EXPECT_NEAR(at(curve, 0.3333f), 1.6666f, 1e-6f);
}

TEST(Curve, outsideItsKeysTheEndValuesHold)
{
    const std::vector<CurveKey<1>> keys{{0.25f, {2.0f}}, {0.5f, {4.0f}}};
    const ScalarCurve curve{std::span<const CurveKey<1>>(keys)};
    EXPECT_EQ(at(curve, 0.0f), 2.0f);
    EXPECT_EQ(at(curve, 1.0f), 4.0f);
    EXPECT_FLOAT_EQ(at(curve, 0.375f), 3.0f);
}

TEST(Curve, timeOutsideLifeIsClamped)
{
    const std::vector<CurveKey<1>> keys{{0.0f, {1.0f}}, {1.0f, {2.0f}}};
    const ScalarCurve curve{std::span<const CurveKey<1>>(keys)};
    EXPECT_EQ(at(curve, -5.0f), 1.0f);
    EXPECT_EQ(at(curve, 5.0f), 2.0f);
    EXPECT_EQ(at(curve, std::numeric_limits<float>::quiet_NaN()), 1.0f);
    EXPECT_EQ(at(curve, std::numeric_limits<float>::infinity()), 2.0f);
}

TEST(Curve, equalTimesMakeAJumpWhoseLaterKeyHolds)
{
    const std::vector<CurveKey<1>> keys{{0.0f, {0.0f}}, {0.5f, {0.0f}}, {0.5f, {1.0f}}, {1.0f, {1.0f}}};
    const ScalarCurve curve{std::span<const CurveKey<1>>(keys)};
    EXPECT_EQ(at(curve, 0.48f), 0.0f);
    EXPECT_EQ(at(curve, 0.5f), 1.0f);
    EXPECT_EQ(at(curve, 0.75f), 1.0f);
}

TEST(Curve, colorsInterpolateEachChannel)
{
    const std::vector<CurveKey<3>> keys{{0.0f, {0, 1, 2}}, {1.0f, {2, 1, 0}}};
    const ColorCurve curve{std::span<const CurveKey<3>>(keys)};
    EXPECT_EQ(curve.at(0.5f), (std::array{1.0f, 1.0f, 1.0f}));
}

TEST(Range, endsAtItsLimits)
{
    const Range range{2.0f, 4.0f};
    EXPECT_EQ(range.at(0.0f), 2.0f);
    EXPECT_EQ(range.at(0.5f), 3.0f);
    EXPECT_EQ((Range{5.0f, 5.0f}).at(0.77f), 5.0f);
}
