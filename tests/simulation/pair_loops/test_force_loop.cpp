#include "tests/foundation/every_set.h"
#include "tests/simulation/pair_loops/pair_reference.h"

#include <gtest/gtest.h>

#include <cstring>

namespace {

using namespace fx;
using namespace fx::test;
using sim::SphKernel;

template <class T>
class ForceLoop : public testing::Test
{
protected:
    static constexpr bool kIsFloat = sizeof(T) == 4;
    static constexpr double kBound = kIsFloat ? 4e-6 : 2e-14; ///< of the sum of absolute terms
};

using Precisions = testing::Types<float, double>;
TYPED_TEST_SUITE(ForceLoop, Precisions);

/// Particles of all states, with supports that differ by half.
Gas mixedGas()
{
    Gas gas = latticeGas(6, 0.9, 40);
    stir(gas);
    for (uint32_t i = 0; i < gas.size(); ++i)
        gas[i].support *= 0.8 + 0.5 * chance(4, i, 0);
    return gas;
}

TYPED_TEST(ForceLoop, agreesWithTheReferenceForEveryKernel)
{
    const GasStage<TypeParam> stage(mixedGas());
    const Gas seen = stage.seen();
    for (const SphKernel kernel : sim::kSphKernels) {
        sim::ForceRules rules;
        rules.kernel = kernel;
        rules.beta = 2.5;
        rules.conductivity = 0.7;
        const auto found = stage.forces(rules);
        const double bound = this->kBound;
        for (uint32_t i = 0; i < seen.size(); i += 3) {
            const ReferenceForce want = referenceForce(seen, {}, rules, i);
            EXPECT_NEAR(double(found.ax[i]), want.acceleration.x, bound * want.accelerationScale);
            EXPECT_NEAR(double(found.ay[i]), want.acceleration.y, bound * want.accelerationScale);
            EXPECT_NEAR(double(found.az[i]), want.acceleration.z, bound * want.accelerationScale);
            EXPECT_NEAR(double(found.heating[i]), want.heating, bound * want.heatingScale);
            EXPECT_NEAR(double(found.signalSpeed[i]), want.signalSpeed, 4e-7 * want.signalSpeed);
            EXPECT_EQ(double(found.fastestNeighbor[i]), want.fastestNeighbor);
            EXPECT_EQ(found.pairs[i], want.pairs);
        }
    }
}

TYPED_TEST(ForceLoop, pushesBothParticlesOfAPairExactlyAlike)
{
    for (uint32_t run = 0; run < 200; ++run) {
        Gas gas{parcel(0.9 + 0.1 * chance(run, 0, 0), 0.5, 0.5, 0.2),
                parcel(0.1 * chance(run, 1, 1), 0.5 + 0.05 * chance(run, 1, 2), 0.5,
                       0.2 + 0.1 * chance(run, 1, 3))};
        stir(gas, run);
        gas[1].mass = 4; // powers of two, so that the test divides exactly
        const GasStage<TypeParam> stage(gas, unitBox(sim::AxisKind::Periodic)); // across a side
        const auto found = stage.forces({});
        ASSERT_EQ(found.ax[0], -4 * found.ax[1]);
        ASSERT_EQ(found.ay[0], -4 * found.ay[1]);
        ASSERT_EQ(found.az[0], -4 * found.az[1]);
        ASSERT_EQ(found.pairs[0], found.pairs[1]);
        if (found.pairs[0] > 0) {
            ASSERT_NE(found.ax[0], 0);
        }
    }
}

TYPED_TEST(ForceLoop, conservesMomentumAndEnergy)
{
    const GasStage<TypeParam> stage(mixedGas(), unitBox(sim::AxisKind::Periodic));
    const Gas seen = stage.seen();
    const sim::Domain box = unitBox(sim::AxisKind::Periodic);
    const auto found = stage.forces({});
    glm::dvec3 momentum(0.0);
    double energy = 0, momentumScale = 0, energyScale = 0;
    for (uint32_t i = 0; i < seen.size(); ++i) {
        const glm::dvec3 a(found.ax[i], found.ay[i], found.az[i]), v(seen[i].vx, seen[i].vy, seen[i].vz);
        const double work = referenceForce(seen, box, {}, i).pressureWork;
        momentum += seen[i].mass * a;
        momentumScale += seen[i].mass * glm::length(a);
        energy += seen[i].mass * (glm::dot(v, a) + double(found.heating[i]) + work);
        energyScale += seen[i].mass * (std::abs(glm::dot(v, a)) + std::abs(work));
    }
    EXPECT_LT(glm::length(momentum), (this->kIsFloat ? 1e-6 : 1e-14) * momentumScale);
    EXPECT_LT(std::abs(energy), (this->kIsFloat ? 1e-6 : 1e-14) * energyScale);
}

TYPED_TEST(ForceLoop, viscosityHeatsAndConductionEqualizes)
{
    Gas gas{parcel(0, 0, 0, 1), parcel(0.4, 0, 0, 1)};
    gas[0].vx = 1; // approaching
    auto found = GasStage<TypeParam>(gas).forces({});
    EXPECT_GT(found.heating[0], 0);
    EXPECT_EQ(found.heating[0], found.heating[1]);
    EXPECT_EQ(double(found.signalSpeed[0]), 2.0 + 3.0);
    gas[0].vx = -1; // receding: pressure alone
    found = GasStage<TypeParam>(gas).forces({});
    EXPECT_EQ(found.heating[0], 0);
    EXPECT_EQ(double(found.signalSpeed[0]), 2.0);
    gas[0].vx = 0;
    gas[0].energy = 3; // hot and at another pressure
    gas[0].pressure = 2;
    found = GasStage<TypeParam>(gas).forces({});
    EXPECT_LT(found.heating[0], 0);
    EXPECT_EQ(found.heating[0], -found.heating[1]);
    sim::ForceRules rules;
    rules.conductivity = 0;
    EXPECT_EQ(GasStage<TypeParam>(gas).forces(rules).heating[0], 0);
}

TYPED_TEST(ForceLoop, feelsWhomeverEitherOfTheTwoReaches)
{
    const Gas gas{parcel(0, 0, 0, 0.1), parcel(0.5, 0, 0, 1), parcel(0, 3, 0, 0.5)};
    const auto found = GasStage<TypeParam>(gas).forces({});
    EXPECT_EQ(found.pairs, (std::vector<uint32_t>{1, 1, 0}));
    EXPECT_LT(found.ax[0], 0);
    EXPECT_EQ(found.ax[0], -found.ax[1]);
    EXPECT_EQ(found.ax[2], 0);
}

TYPED_TEST(ForceLoop, tellsTheSmallestStepAround)
{
    Gas gas{parcel(0, 0, 0, 1), parcel(0.5, 0, 0, 0.1), parcel(-0.5, 0, 0, 0.1), parcel(5, 0, 0, 1)};
    gas[0].stepLevel = 2;
    gas[1].stepLevel = 7;
    gas[2].stepLevel = 9;
    gas[3].stepLevel = 5;
    const auto found = GasStage<TypeParam>(gas).forces({});
    EXPECT_EQ(found.fastestNeighbor, (std::vector<TypeParam>{7, 2, 2, 5}));
}

template <class T>
bool sameBits(const Forces<T>& a, const Forces<T>& b)
{
    const auto same = [](const auto& x, const auto& y) {
        return std::memcmp(x.data(), y.data(), x.size() * sizeof(x[0])) == 0;
    };
    return same(a.ax, b.ax) && same(a.ay, b.ay) && same(a.az, b.az) && same(a.heating, b.heating) &&
           same(a.signalSpeed, b.signalSpeed) && same(a.fastestNeighbor, b.fastestNeighbor) &&
           same(a.pairs, b.pairs);
}

TYPED_TEST(ForceLoop, hasTheSameBitsForEveryInstructionSetAndLengthOfList)
{
    for (const uint32_t n : {0u, 1u, 2u, 15u, 16u, 17u, 31u, 32u, 33u, 63u, 64u, 65u, 300u}) {
        Gas gas{parcel(0, 0, 0, 1)};
        for (uint32_t i = 0; i < n; ++i)
            gas.push_back(parcel(chance(5, i, 0) - 0.5, chance(5, i, 1) - 0.5, chance(5, i, 2) - 0.5, 1));
        stir(gas, n);
        for (uint32_t twin = 1; twin < gas.size(); twin += 20) // some coincide
            gas[twin].x = gas[twin].y = gas[twin].z = 0.25;
        const GasStage<TypeParam> whole(gas, {}, 0.2, 600), pieces(gas, {}, 0.2, 0);
        for (const SphKernel kernel : sim::kSphKernels) {
            sim::ForceRules rules;
            rules.kernel = kernel;
            Forces<TypeParam> scalar;
            everySet([&](base::InstructionSet set) {
                const auto found = whole.forces(rules);
                if (set == base::InstructionSet::Scalar)
                    scalar = found;
                EXPECT_TRUE(sameBits(found, scalar)) << n << " neighbors";
                EXPECT_TRUE(sameBits(pieces.forces(rules), scalar)) << n << " neighbors, list in pieces";
                EXPECT_EQ(found.pairs[0], n);
            });
        }
    }
}

} // namespace
