#include "benchmarks/scenes/gas_stage.h"
#include "tests/foundation/every_set.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>

namespace {

using namespace fx;
using namespace fx::bench;
using namespace fx::test;

constexpr double kRange = 0.5;

/// Particles of many masses and supports.
Gas mixedGas()
{
    Gas gas = latticeGas(6, 0.9, 40);
    for (uint32_t i = 0; i < gas.size(); ++i) {
        gas[i].support *= 0.8 + 0.5 * chance(4, i, 0);
        gas[i].mass *= 0.5 + 3.0 * chance(4, i, 1);
    }
    return gas;
}

glm::dvec3 placeOf(const sim::GasRecord<double>& p)
{
    return {p.x, p.y, p.z};
}

/// particle-concentration (1) and (2), over all pairs.
struct Reference
{
    Reference(const Gas& gas, uint32_t i)
    {
        for (uint32_t j = 0; j < gas.size(); ++j) {
            const glm::dvec3 d = placeOf(gas[i]) - placeOf(gas[j]);
            const double r = glm::length(d);
            const double range = kRange * std::max(gas[i].support, gas[j].support);
            if (j != i && r < range)
                gradient += d / r * range * std::pow(1.0 - r / range, 2) * 2.0 * gas[j].mass /
                            (gas[i].mass + gas[j].mass);
            if (r < gas[i].support)
                outward += d * (1.0 - r * r / (gas[i].support * gas[i].support));
        }
    }
    glm::dvec3 gradient{0.0}, outward{0.0};
};

template <class T>
class ConcentrationLoop : public testing::Test
{
protected:
    static constexpr double kBound = sizeof(T) == 4 ? 4e-6 : 1e-14; ///< [m] terms are below the support
};
using Precisions = testing::Types<float, double>;
TYPED_TEST_SUITE(ConcentrationLoop, Precisions);

} // namespace

TYPED_TEST(ConcentrationLoop, agreesWithTheSumOverAllPairs)
{
    const GasStage<TypeParam> stage(mixedGas());
    const Gas seen = stage.seen();
    const auto found = stage.concentration(kRange);
    double largest = 0;
    for (uint32_t i = 0; i < seen.size(); ++i) {
        const Reference want(seen, i);
        largest = std::max(largest, glm::length(want.gradient));
        EXPECT_NEAR(double(found.x[i]), want.gradient.x, this->kBound);
        EXPECT_NEAR(double(found.y[i]), want.gradient.y, this->kBound);
        EXPECT_NEAR(double(found.z[i]), want.gradient.z, this->kBound);
        EXPECT_NEAR(double(found.outwardX[i]), want.outward.x, 4 * this->kBound);
        EXPECT_NEAR(double(found.outwardY[i]), want.outward.y, 4 * this->kBound);
        EXPECT_NEAR(double(found.outwardZ[i]), want.outward.z, 4 * this->kBound);
    }
    EXPECT_GT(largest, 0.02);
}

TYPED_TEST(ConcentrationLoop, leavesTheCenterOfMassWhereItIs)
{
    const GasStage<TypeParam> stage(mixedGas());
    const Gas seen = stage.seen();
    const auto found = stage.concentration(kRange);
    glm::dvec3 sum(0.0);
    double scale = 0;
    for (uint32_t i = 0; i < seen.size(); ++i) {
        const glm::dvec3 moved = seen[i].mass * glm::dvec3(found.x[i], found.y[i], found.z[i]);
        sum += moved;
        scale += glm::length(moved);
    }
    EXPECT_LE(glm::length(sum), this->kBound * scale);
}

TYPED_TEST(ConcentrationLoop, seesNothingInALatticeWiderThanItsRangeNorAtOnePlace)
{
    const GasStage<TypeParam> lattice(latticeGas(5, 0.0, 40), unitBox(sim::AxisKind::Periodic));
    const auto found = lattice.concentration(0.4); // the support is 2.1 spacings
    for (const TypeParam x : found.x)
        EXPECT_EQ(x, TypeParam(0));
    const GasStage<TypeParam> pair(Gas{parcel(0.5, 0.5, 0.5, 0.2), parcel(0.5, 0.5, 0.5, 0.2)});
    EXPECT_EQ(pair.concentration(kRange).x[0], TypeParam(0));
}

TYPED_TEST(ConcentrationLoop, givesTheSameBitsWithEveryInstructionSet)
{
    const GasStage<TypeParam> stage(mixedGas());
    const auto widest = stage.concentration(kRange);
    everySet([&](base::InstructionSet) {
        const auto found = stage.concentration(kRange);
        EXPECT_EQ(found.x, widest.x);
        EXPECT_EQ(found.outwardZ, widest.outwardZ);
    });
}
