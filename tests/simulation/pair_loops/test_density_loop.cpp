#include "tests/foundation/every_set.h"
#include "tests/simulation/pair_loops/pair_reference.h"

#include <gtest/gtest.h>

#include <cstring>

namespace {

using namespace fx;
using namespace fx::test;
using sim::SphKernel;

template <class T>
class DensityLoop : public testing::Test
{
protected:
    static constexpr bool kIsFloat = sizeof(T) == 4;
    static constexpr double kBound = kIsFloat ? 4e-6 : 2e-14; ///< of the sum of positive terms

    static sim::DensityRules rulesFor(SphKernel kernel, double neighbors)
    {
        sim::DensityRules rules;
        rules.kernel = kernel;
        rules.neighbors = neighbors;
        rules.tolerance = kIsFloat ? 1e-4 : 1e-10;
        return rules;
    }
};

using Precisions = testing::Types<float, double>;
TYPED_TEST_SUITE(DensityLoop, Precisions);

TYPED_TEST(DensityLoop, ofAUniformLatticeIsThatOfTheGas)
{
    const struct
    {
        SphKernel kernel;
        double neighbors;
    } cases[] = {{SphKernel::WendlandC2, 58}, {SphKernel::WendlandC4, 150}, {SphKernel::CubicSpline, 48}};
    for (const auto& [kernel, neighbors] : cases) {
        const GasStage<TypeParam> stage(latticeGas(10, 0.0, neighbors), unitBox(sim::AxisKind::Periodic),
                                        0.1);
        const auto found = stage.densities(this->rulesFor(kernel, neighbors), 0.1);
        for (const TypeParam density : found.density)
            ASSERT_NEAR(double(density), 1.0, 0.01) << sim::kernelFacts(kernel).name;
    }
}

TYPED_TEST(DensityLoop, agreesWithTheReferenceForEveryKernel)
{
    Gas gas = latticeGas(7, 0.7, 40);
    stir(gas);
    for (const SphKernel kernel : sim::kSphKernels) {
        const GasStage<TypeParam> stage(gas, {}, 0.3);
        const auto rules = this->rulesFor(kernel, 40);
        const double bias = sim::selfBias(kernel, 40);
        const auto found = stage.densities(rules, 0.3);
        const Gas seen = stage.seen();
        for (uint32_t i = 0; i < gas.size(); i += 7) {
            const double H = double(found.support[i]);
            const ReferenceDensity want = referenceDensity(seen, {}, kernel, bias, i, H);
            EXPECT_NEAR(double(found.density[i]), want.density, this->kBound * want.density);
            EXPECT_EQ(found.neighbors[i], want.neighbors);
            if (found.wantsReach[i])
                continue;
            EXPECT_NEAR(double(found.correction[i]), want.correction, this->kIsFloat ? 2e-5 : 1e-6);
            EXPECT_NEAR(double(found.divergence[i]), want.divergence, this->kIsFloat ? 1e-4 : 1e-11);
            EXPECT_NEAR(double(found.curl[i]), glm::length(want.curl), this->kIsFloat ? 1e-4 : 1e-11);
        }
    }
}

TYPED_TEST(DensityLoop, makesTheSupportHoldItsMass)
{
    const Gas gas = latticeGas(8, 0.9, 58);
    const GasStage<TypeParam> stage(gas, unitBox(sim::AxisKind::Periodic), 0.5);
    const auto found = stage.densities(this->rulesFor(SphKernel::WendlandC2, 58), 0.5);
    for (uint32_t i = 0; i < gas.size(); ++i) {
        const double H = double(found.support[i]);
        const double held = H * H * H * double(found.density[i]);
        const double want = 3 * 58 * gas[i].mass / (4 * std::numbers::pi);
        ASSERT_NEAR(held / want, 1.0, 3 * 2 * (this->kIsFloat ? 1e-4 : 1e-9));
        ASSERT_FALSE(found.wantsReach[i]);
    }
}

TYPED_TEST(DensityLoop, expansionIsTheRateAtWhichTheSumChangesAsParticlesMove)
{
    Gas gas = latticeGas(7, 0.7, 40);
    stir(gas);
    const auto rules = this->rulesFor(SphKernel::WendlandC2, 40);
    const auto found = GasStage<TypeParam>(gas, {}, 0.3).densities(rules, 0.3);
    constexpr double kTime = 1e-4; // a thousandth of a spacing; differences in double tell the truth
    const auto densitiesAt = [&](double time) {
        Gas moved = gas;
        for (auto& p : moved) {
            p.x += time * p.vx;
            p.y += time * p.vy;
            p.z += time * p.vz;
        }
        sim::DensityRules exact = rules;
        exact.tolerance = 1e-12;
        return GasStage<double>(moved, {}, 0.3).densities(exact, 0.3);
    };
    const auto before = densitiesAt(-kTime), after = densitiesAt(kTime);
    double farthest = 0;
    for (uint32_t i = 0; i < gas.size(); ++i) {
        if (found.wantsReach[i])
            continue;
        const double middle = 0.5 * (before.density[i] + after.density[i]);
        const double want = (before.density[i] - after.density[i]) / (2 * kTime * middle);
        ASSERT_NEAR(double(found.expansion[i]), want, 2e-3) << i;
        farthest = std::max(farthest, std::abs(double(found.divergence[i]) - want));
    }
    EXPECT_GT(farthest, 0.1); // in disorder the divergence is another number
}

TYPED_TEST(DensityLoop, exposureIsNothingInsideMuchInTheOutermostLayerAndOneAlone)
{
    const auto rules = this->rulesFor(SphKernel::WendlandC2, 58);
    const GasStage<TypeParam> periodic(latticeGas(8, 0.0, 58), unitBox(sim::AxisKind::Periodic), 0.1);
    for (const TypeParam exposure : periodic.densities(rules, 0.1).exposure)
        ASSERT_NEAR(double(exposure), 0.0, 1e-5);

    Gas half = latticeGas(16, 0.0, 58);
    const GasStage<TypeParam> open(half, {}, 0.3);
    const auto found = open.densities(rules, 0.3);
    for (size_t i = 0; i < half.size(); ++i) {
        const glm::dvec3 p(half[i].x, half[i].y, half[i].z);
        const bool isMiddle = std::abs(p.x - 0.5) < 0.1 && std::abs(p.y - 0.5) < 0.1;
        if (isMiddle && std::abs(p.z - 0.5) < 0.1) {
            EXPECT_LT(double(found.exposure[i]), 1e-3);
        } else if (isMiddle && (p.z < 0.05 || p.z > 0.95)) {
            EXPECT_NEAR(double(found.exposure[i]), 0.6, 0.1); // half a spacing below the surface
        }
    }
    const GasStage<TypeParam> lone(Gas(half.begin(), half.begin() + 1), {}, 0.1);
    EXPECT_EQ(double(lone.densities(rules, 0.1).exposure[0]), 1.0);
}

TYPED_TEST(DensityLoop, leavesOutTheBiasOfTheOwnContribution)
{
    const GasStage<TypeParam> stage(latticeGas(8, 0.0, 58), unitBox(sim::AxisKind::Periodic), 0.1);
    sim::DensityRules rules = this->rulesFor(SphKernel::WendlandC2, 58);
    rules.smallestSupport = rules.largestSupport = double(stage.seen()[0].support);
    const double with = double(stage.densities(rules).density[0]);
    rules.subtractSelfBias = false;
    const double without = double(stage.densities(rules).density[0]);
    const double own = sim::kernelValue(SphKernel::WendlandC2, 0, rules.largestSupport) / 512;
    EXPECT_NEAR(without - with, own * sim::selfBias(SphKernel::WendlandC2, 58), 1e-6);
}

TYPED_TEST(DensityLoop, givesALinearFlowItsExactGradient)
{
    Gas gas = latticeGas(8, 0.9, 58);
    for (auto& p : gas) {
        const glm::dvec3 x(p.x, p.y, p.z);
        p.vx = glm::dot(glm::dvec3(1.0, 2.0, -3.0), x);
        p.vy = glm::dot(glm::dvec3(0.5, -4.0, 1.0), x);
        p.vz = glm::dot(glm::dvec3(2.0, 0.3, 1.2), x);
    }
    const GasStage<TypeParam> stage(gas, {}, 0.5); // open: corners and faces have lopsided neighborhoods
    const auto found = stage.densities(this->rulesFor(SphKernel::WendlandC2, 58), 0.5);
    const double curl = glm::length(glm::dvec3(0.3 - 1.0, -3.0 - 2.0, 0.5 - 2.0));
    const double bound = this->kIsFloat ? 2e-4 : 1e-12;
    for (uint32_t i = 0; i < gas.size(); ++i) {
        ASSERT_NEAR(double(found.divergence[i]), 1.0 - 4.0 + 1.2, bound);
        ASSERT_NEAR(double(found.curl[i]), curl, bound);
    }
}

/// One particle amid n others, all inside of its support.
Gas crowd(uint32_t n)
{
    Gas gas{parcel(0, 0, 0, 1)};
    for (uint32_t i = 0; i < n; ++i)
        gas.push_back(parcel(chance(5, i, 0) - 0.5, chance(5, i, 1) - 0.5, chance(5, i, 2) - 0.5, 1));
    stir(gas, n + 3);
    return gas;
}

template <class T>
bool sameBits(const Densities<T>& a, const Densities<T>& b)
{
    const auto same = [](const auto& x, const auto& y) {
        return std::memcmp(x.data(), y.data(), x.size() * sizeof(x[0])) == 0;
    };
    return same(a.support, b.support) && same(a.density, b.density) && same(a.correction, b.correction) &&
           same(a.divergence, b.divergence) && same(a.curl, b.curl) && same(a.wantsReach, b.wantsReach) &&
           same(a.expansion, b.expansion) && same(a.neighbors, b.neighbors);
}

TYPED_TEST(DensityLoop, hasTheSameBitsForEveryInstructionSetAndLengthOfList)
{
    for (const uint32_t n : {0u, 1u, 2u, 15u, 16u, 17u, 31u, 32u, 33u, 63u, 64u, 65u, 511u, 512u, 513u}) {
        const GasStage<TypeParam> stage(crowd(n), {}, 0.2, 600);
        for (const SphKernel kernel : {SphKernel::WendlandC2, SphKernel::CubicSpline}) {
            const auto rules = this->rulesFor(kernel, 20);
            Densities<TypeParam> scalar;
            everySet([&](base::InstructionSet set) {
                const auto found = stage.densities(rules, 0.2);
                if (set == base::InstructionSet::Scalar)
                    scalar = found;
                EXPECT_TRUE(sameBits(found, scalar)) << n << " neighbors";
                EXPECT_EQ(found.neighbors[0] > 0, n > 0);
            });
        }
    }
}

TYPED_TEST(DensityLoop, doesNotCareHowALongListIsCut)
{
    const Gas gas = crowd(1500); // three blocks of neighbors
    const auto rules = this->rulesFor(SphKernel::WendlandC2, 400);
    const auto whole = GasStage<TypeParam>(gas, {}, 0.2, 2000).densities(rules, 0.2);
    const auto pieces = GasStage<TypeParam>(gas, {}, 0.2, 0).densities(rules, 0.2); // no room: searched anew
    EXPECT_TRUE(sameBits(whole, pieces));
    const Gas seen = GasStage<TypeParam>(gas, {}, 0.2, 0).seen();
    const double bias = sim::selfBias(SphKernel::WendlandC2, 400);
    const double H = double(whole.support[0]);
    const double want = referenceDensity(seen, {}, SphKernel::WendlandC2, bias, 0, H).density;
    EXPECT_NEAR(double(whole.density[0]), want, this->kBound * want);
}

} // namespace
