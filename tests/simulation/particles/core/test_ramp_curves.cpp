#include "simulation/particles/ramp_curves.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace fx;
using namespace fx::sim;

namespace {

template <size_t K>
base::ScalarCurve curve(const std::array<base::CurveKey<1>, K>& keys)
{
    return base::ScalarCurve(std::span<const base::CurveKey<1>>(keys));
}

RampCurves oneChannel(const base::ScalarCurve& of)
{
    const auto samples = samplesOf(of, 0);
    return RampCurves(std::span(&samples, 1));
}

/// (1) of ramp-curves, in double.
double sumOfRamps(const RampCurves& curves, uint32_t channel, double t)
{
    double sum = double(curves.start[channel]) + double(curves.slope[channel]) * t;
    for (uint32_t k = 0; k < curves.ramps; ++k)
        sum += double(curves.bend[channel][k]) * std::max(t - double(curves.at[k]), 0.0);
    return sum;
}

} // namespace

TEST(RampCurves, aFewKeysBecomeAsManyRampsThatAllChannelsShare)
{
    const auto up = curve(std::array<base::CurveKey<1>, 3>{{{0, {0}}, {0.25f, {1}}, {1, {1}}}});
    const auto down = curve(std::array<base::CurveKey<1>, 3>{{{0, {2}}, {0.5f, {2}}, {1, {0}}}});
    const RampCurves curves(std::array{samplesOf(up, 0), samplesOf(down, 0)});
    EXPECT_FALSE(curves.byTable);
    EXPECT_EQ(curves.ramps, 2u);
    for (int i = 0; i <= 1000; ++i) {
        const float t = float(i) / 1000.0f;
        ASSERT_NEAR(sumOfRamps(curves, 0, double(t)), double(up.at(t)[0]), 4e-6) << t;
        ASSERT_NEAR(sumOfRamps(curves, 1, double(t)), double(down.at(t)[0]), 4e-6) << t;
    }
}

TEST(RampCurves, aConstantStaysExactAndHasNoRamps)
{
    const RampCurves curves = oneChannel(base::ScalarCurve(std::array{0.3f}));
    EXPECT_TRUE(curves.isConstant(0));
    EXPECT_EQ(curves.ramps, 0u);
    EXPECT_EQ(curves.start[0], 0.3f);
}

TEST(RampCurves, manyKeysAreLookedUp)
{
    std::array<base::CurveKey<1>, 17> keys;
    for (size_t i = 0; i < keys.size(); ++i)
        keys[i] = {float(i) / 16.0f, {i % 2 == 0 ? 0.0f : 1.0f}};
    EXPECT_TRUE(oneChannel(curve(keys)).byTable);
}
