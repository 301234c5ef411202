#include "tests/foundation/every_set.h"
#include "tests/simulation/pair_loops/pair_reference.h"

#include <gtest/gtest.h>

namespace {

using namespace fx;
using namespace fx::test;

Gas boxGas()
{
    Gas gas = latticeGas(6, 0.9, 30);
    stir(gas);
    return gas;
}

/// The same gas with the images of its particles given as particles, the originals first.
Gas withImages(const Gas& gas, const sim::Domain& domain)
{
    Gas all = gas;
    const Gas open = gas;
    for (int code = 1; code < 27; ++code) {
        const int way[3] = {code % 3, code / 3 % 3, code / 9};
        for (sim::GasRecord<double> p : open) {
            double* const x[3] = {&p.x, &p.y, &p.z};
            double* const v[3] = {&p.vx, &p.vy, &p.vz};
            bool exists = true;
            for (int a = 0; a < 3; ++a) {
                if (way[a] == 0)
                    continue;
                const auto kind = domain.axes[size_t(a)];
                exists = exists && kind != sim::AxisKind::Open;
                if (kind == sim::AxisKind::Periodic)
                    *x[a] += way[a] == 1 ? 1.0 : -1.0;
                if (kind == sim::AxisKind::Reflecting) {
                    *x[a] = (way[a] == 1 ? 0.0 : 2.0) - *x[a];
                    *v[a] = -*v[a];
                }
            }
            const bool isClose =
                std::abs(p.x - 0.5) < 1 && std::abs(p.y - 0.5) < 1 && std::abs(p.z - 0.5) < 1;
            if (exists && isClose)
                all.push_back(p);
        }
    }
    return all;
}

void expectLikeExplicitImages(const sim::Domain& domain)
{
    const Gas gas = boxGas();
    const GasStage<double> boxed(gas, domain, 0.3), open(withImages(gas, domain), {}, 0.3);
    sim::DensityRules rules;
    rules.neighbors = 30;
    rules.tolerance = 1e-10;
    const auto d = boxed.densities(rules, 0.3), wantD = open.densities(rules, 0.3);
    const auto f = boxed.forces({}), wantF = open.forces({});
    for (uint32_t i = 0; i < gas.size(); ++i) {
        EXPECT_NEAR(d.support[i], wantD.support[i], 1e-9);
        EXPECT_NEAR(d.density[i], wantD.density[i], 1e-8);
        EXPECT_NEAR(d.divergence[i], wantD.divergence[i], 1e-7);
        EXPECT_NEAR(d.curl[i], wantD.curl[i], 1e-7);
        EXPECT_EQ(d.neighbors[i], wantD.neighbors[i]);
        EXPECT_NEAR(f.ax[i], wantF.ax[i], 1e-10);
        EXPECT_NEAR(f.ay[i], wantF.ay[i], 1e-10);
        EXPECT_NEAR(f.az[i], wantF.az[i], 1e-10);
        EXPECT_NEAR(f.heating[i], wantF.heating[i], 1e-10);
        EXPECT_EQ(f.pairs[i], wantF.pairs[i]);
    }
}

TEST(ImagePairs, periodicSidesShowTheOtherSide)
{
    everySet([](base::InstructionSet) { expectLikeExplicitImages(unitBox(sim::AxisKind::Periodic)); });
    sim::Domain tube = unitBox(sim::AxisKind::Open);
    tube.axes[1] = sim::AxisKind::Periodic;
    expectLikeExplicitImages(tube);
}

TEST(ImagePairs, wallsEdgesAndCornersShowMirroredParticles)
{
    everySet([](base::InstructionSet) { expectLikeExplicitImages(unitBox(sim::AxisKind::Reflecting)); });
    for (size_t axis = 0; axis < 3; ++axis) {
        sim::Domain one = unitBox(sim::AxisKind::Open);
        one.axes[axis] = sim::AxisKind::Reflecting;
        expectLikeExplicitImages(one);
    }
}

TEST(ImagePairs, wallsAndSidesMayMeet)
{
    sim::Domain mixed = unitBox(sim::AxisKind::Periodic);
    mixed.axes[2] = sim::AxisKind::Reflecting;
    expectLikeExplicitImages(mixed);
}

TEST(ImagePairs, agreeWithTheReferenceInFloat)
{
    for (const auto kind : {sim::AxisKind::Periodic, sim::AxisKind::Reflecting}) {
        const GasStage<float> stage(boxGas(), unitBox(kind));
        const auto found = stage.forces({});
        for (uint32_t i = 0; i < stage.count(); i += 5) {
            const ReferenceForce want = referenceForce(stage.seen(), unitBox(kind), {}, i);
            EXPECT_NEAR(double(found.ax[i]), want.acceleration.x, 2e-5 * want.accelerationScale);
            EXPECT_NEAR(double(found.az[i]), want.acceleration.z, 2e-5 * want.accelerationScale);
            EXPECT_NEAR(double(found.heating[i]), want.heating, 2e-5 * want.heatingScale);
        }
    }
}

/// A particle and its neighbor feel each other's images alike along the wall: bit for bit.
TEST(ImagePairs, keepMomentumAlongTheWall)
{
    for (uint32_t run = 0; run < 100; ++run) {
        Gas gas{parcel(0.01 + 0.1 * chance(run, 0, 0), 0.4, 0.5, 0.5),
                parcel(0.01 + 0.1 * chance(run, 1, 0), 0.4 + 0.1 * chance(run, 1, 1), 0.55, 0.45)};
        stir(gas, run);
        sim::Domain wall = unitBox(sim::AxisKind::Open);
        wall.axes[0] = sim::AxisKind::Reflecting;
        // Two terms each, both exactly opposite: so are their sums, as lists have room for both in two lanes.
        const auto found = GasStage<float>(gas, wall).forces({});
        ASSERT_EQ(found.ay[0], -found.ay[1]);
        ASSERT_EQ(found.az[0], -found.az[1]);
        ASSERT_NE(found.ay[0], 0);
    }
}

} // namespace
