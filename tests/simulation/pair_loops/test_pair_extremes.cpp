#include "simulation/sph/pair_loops/parting.h"
#include "tests/foundation/every_set.h"
#include "tests/simulation/pair_loops/pair_reference.h"

#include <gtest/gtest.h>

namespace {

using namespace fx;
using namespace fx::test;

template <class T>
class PairExtremes : public testing::Test
{};
using Precisions = testing::Types<float, double>;
TYPED_TEST_SUITE(PairExtremes, Precisions);

TYPED_TEST(PairExtremes, coincidentParticlesPartAndKeepTheirMomentum)
{
    for (const uint32_t k : {2u, 3u, 16u, 17u, 256u, 4096u}) {
        const Gas gas(k, parcel(0.3, -0.2, 0.7, 1));
        const auto found = GasStage<TypeParam>(gas, {}, 0.0, 100).forces({});
        glm::dvec3 sum(0.0);
        double scale = 0;
        for (uint32_t i = 0; i < k; ++i) {
            const glm::dvec3 a(found.ax[i], found.ay[i], found.az[i]);
            ASSERT_TRUE(std::isfinite(glm::length(a)));
            ASSERT_GT(glm::length(a), 0.0);
            ASSERT_EQ(found.pairs[i], k - 1);
            sum += a;
            scale += glm::length(a);
        }
        if (k == 2) {
            EXPECT_EQ(glm::length(sum), 0.0);
        }
        EXPECT_LT(glm::length(sum), (sizeof(TypeParam) == 4 ? 1e-5 : 1e-13) * scale) << k << " particles";
    }
}

TYPED_TEST(PairExtremes, coincidentParticlesPartByWhoTheyAreNotByWhereTheyStand)
{
    const Gas gas(2, parcel(0, 0, 0, 1));
    const GasStage<TypeParam> stage(gas);
    const uint32_t ids[] = {70, 9}, swapped[] = {9, 70};
    sim::ForceRules rules;
    rules.ids = ids;
    const auto found = stage.forces(rules);
    rules.ids = swapped;
    const auto other = stage.forces(rules);
    EXPECT_EQ(found.ax[0], other.ax[1]);
    EXPECT_EQ(found.az[0], other.az[1]);
    const auto direction = sim::partingDirection<TypeParam>(70, 9);
    EXPECT_GT(found.ax[0] * direction[0], 0);
}

TYPED_TEST(PairExtremes, aParticleOnAWallIsPushedOff)
{
    sim::Domain floor;
    floor.axes[1] = sim::AxisKind::Reflecting;
    floor.low.y = -2;
    const auto found = GasStage<TypeParam>(Gas{parcel(0, -2, 0, 1)}, floor).forces({});
    EXPECT_EQ(found.pairs[0], 1u);
    EXPECT_GT(found.ay[0], 0);
    EXPECT_EQ(found.ax[0], 0);
    sim::Domain ceiling;
    ceiling.axes[1] = sim::AxisKind::Reflecting;
    ceiling.high.y = -2;
    EXPECT_LT(GasStage<TypeParam>(Gas{parcel(0, -2, 0, 1)}, ceiling).forces({}).ay[0], 0);
}

TYPED_TEST(PairExtremes, directionsAreUnitVectorsAndOpposite)
{
    for (uint32_t k = 0; k < 1000; ++k) {
        const auto a = sim::partingDirection<TypeParam>(k, 2 * k + 1),
                   b = sim::partingDirection<TypeParam>(2 * k + 1, k);
        double square = 0;
        for (size_t axis = 0; axis < 3; ++axis) {
            ASSERT_EQ(a[axis], -b[axis]);
            square += double(a[axis]) * double(a[axis]);
        }
        ASSERT_NEAR(square, 1.0, 1e-6);
    }
}

TYPED_TEST(PairExtremes, aLoneParticleReachesAsFarAsItMay)
{
    const GasStage<TypeParam> stage(Gas{parcel(0, 0, 0, 1)});
    sim::DensityRules rules;
    rules.largestSupport = 5;
    auto found = stage.densities(rules, 10.0);
    EXPECT_EQ(double(found.support[0]), 5.0);
    EXPECT_EQ(found.wantsReach[0], 0);
    EXPECT_EQ(double(found.correction[0]), 1.0);
    EXPECT_EQ(found.neighbors[0], 0u);
    EXPECT_EQ(double(found.divergence[0]), 0.0);
    const double own =
        sim::kernelValue(rules.kernel, 0, 5) * (1 - sim::selfBias(rules.kernel, rules.neighbors));
    EXPECT_NEAR(double(found.density[0]), own, 1e-6 * own);
    found = stage.densities(rules, 0.25); // the list covers no more
    EXPECT_EQ(double(found.support[0]), 1.25);
    EXPECT_EQ(found.wantsReach[0], 1);
}

TYPED_TEST(PairExtremes, coincidentParticlesTakeTheSmallestSupport)
{
    const GasStage<TypeParam> stage(Gas(100, parcel(0, 0, 0, 1)));
    sim::DensityRules rules;
    rules.smallestSupport = 0.125;
    const auto found = stage.densities(rules, 0.1);
    for (uint32_t i = 0; i < 100; ++i) {
        EXPECT_EQ(double(found.support[i]), 0.125);
        EXPECT_EQ(double(found.correction[i]), 1.0);
        EXPECT_EQ(found.neighbors[i], 99u);
    }
}

TYPED_TEST(PairExtremes, supportsStayInBoundsForCloudsWithFarOutliers)
{
    for (uint32_t run = 0; run < 20; ++run) {
        Gas gas;
        for (uint32_t i = 0; i < 300; ++i) {
            const double far = i % 10 == 0 ? std::pow(10.0, 8 * chance(run, i, 3)) : 1.0;
            gas.push_back(
                parcel(far * chance(run, i, 0), far * chance(run, i, 1), far * chance(run, i, 2), 0.3 * far));
            gas.back().mass = std::pow(10.0, -3 * chance(run, i, 4));
        }
        sim::DensityRules rules;
        rules.neighbors = 30;
        rules.smallestSupport = 1e-3;
        rules.largestSupport = 1e3;
        const auto found = GasStage<TypeParam>(gas, {}, 0.26, 60).densities(rules, 0.26);
        for (uint32_t i = 0; i < gas.size(); ++i) {
            ASSERT_GE(double(found.support[i]), 1e-3);
            ASSERT_LE(double(found.support[i]), std::min(1e3, 0.3 * std::pow(10.0, 8) * 1.26));
            ASSERT_LE(double(found.support[i]), std::max(1e-3, gas[i].support * 1.26 * 1.000001));
            ASSERT_TRUE(std::isfinite(double(found.density[i])) && double(found.density[i]) > 0);
            ASSERT_TRUE(double(found.correction[i]) >= 0.2 && double(found.correction[i]) <= 5);
            ASSERT_TRUE(std::isfinite(double(found.divergence[i])) && std::isfinite(double(found.curl[i])));
        }
    }
}

} // namespace
