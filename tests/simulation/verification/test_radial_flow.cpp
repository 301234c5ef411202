#include "simulation/verification/radial_flow.h"

#include "simulation/verification/noh_implosion.h"
#include "simulation/verification/riemann_problem.h"
#include "simulation/verification/sedov_blast.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace fx::sim {
namespace {

double errorInSodsTube(int cells)
{
    const RiemannProblem exact({1, 0, 1}, {0.125, 0, 0.1}, 1.4);
    RadialFlowDef def;
    def.spherical = false;
    def.cells = cells;
    def.initial = [](double x) { return x < 0.5 ? FlowState{1, 0, 1} : FlowState{0.125, 0, 0.1}; };
    RadialFlow flow(def);
    flow.advanceTo(0.2);
    double error = 0;
    for (int i = 0; i < 2000; ++i) {
        const double x = (i + 0.5) / 2000;
        error += std::abs(flow.at(x).density - exact.at((x - 0.5) / 0.2).density) / 2000;
    }
    return error;
}

TEST(RadialFlow, sodsTubeConvergesToTheExactFlow)
{
    const double coarse = errorInSodsTube(200);
    const double fine = errorInSodsTube(400);
    EXPECT_LT(fine, 0.002);
    EXPECT_LT(fine, 0.65 * coarse);
}

TEST(RadialFlow, aPointBlastFollowsTheSimilaritySolution)
{
    const double gamma = 5.0 / 3.0;
    const double core = 0.02;
    const double hot = (gamma - 1) / (4 * std::numbers::pi / 3 * core * core * core);
    RadialFlowDef def;
    def.gamma = gamma;
    def.cells = 800;
    def.length = 0.5;
    def.initial = [&](double r) { return FlowState{1, 0, r < core ? hot : 1e-6}; };
    RadialFlow flow(def);
    const double energy = flow.energy();
    flow.advanceTo(0.05);
    EXPECT_NEAR(flow.energy(), energy, 1e-10 * energy);

    const SedovBlast exact(gamma, energy, 1);
    double top = 0;
    double place = 0;
    for (double r = 0.2; r < 0.45; r += 1e-4) {
        if (flow.at(r).density > top) {
            top = flow.at(r).density;
            place = r;
        }
    }
    EXPECT_NEAR(place, exact.shockRadius(0.05), 0.01 * place);
    EXPECT_NEAR(top, 4, 0.4);
    for (double r : {0.2, 0.25, 0.3}) {
        EXPECT_NEAR(flow.at(r).pressure, exact.at(r, 0.05).pressure, 0.03 * exact.at(r, 0.05).pressure);
        EXPECT_NEAR(flow.at(r).velocity, exact.at(r, 0.05).velocity, 0.03 * exact.at(r, 0.05).velocity);
    }
}

TEST(RadialFlow, fallingGasIsCompressedAsNohSays)
{
    RadialFlowDef def;
    def.gamma = 5.0 / 3.0;
    def.cells = 400;
    def.outerWall = false;
    def.initial = [](double) { return FlowState{1, -1, 1e-6}; };
    RadialFlow flow(def);
    flow.advanceTo(0.6);
    const NohImplosion exact;
    EXPECT_NEAR(flow.at(0.15).density, 64, 3);
    EXPECT_NEAR(flow.at(0.15).pressure, exact.at(0.15, 0.6).pressure, 1);
    EXPECT_NEAR(flow.at(0.25).density, exact.at(0.25, 0.6).density, 0.3);
}

TEST(RadialFlow, gasAtRestStaysAtRest)
{
    RadialFlowDef def;
    def.cells = 50;
    def.initial = [](double) { return FlowState{2, 0, 3}; };
    RadialFlow flow(def);
    flow.advanceTo(1);
    EXPECT_NEAR(flow.at(0.3).density, 2, 1e-12);
    EXPECT_NEAR(flow.at(0.3).velocity, 0, 1e-12);
}

TEST(RadialFlow, aWallStopsGasWithThePressureOfAShock)
{
    // The mirror image of gas that hits a wall is gas that collides: an exact Riemann problem.
    const double wall = RiemannProblem({1, 2, 1}, {1, -2, 1}, 1.4).starPressure();
    RadialFlowDef def;
    def.spherical = false;
    def.cells = 20;
    def.initial = [](double) { return FlowState{1, -2, 1}; };
    RadialFlow flow(def);
    const double time = 1e-6;
    flow.advanceTo(time);
    const double push = (flow.at(0).velocity + 2) / time * (1.0 / def.cells);
    EXPECT_NEAR(push, wall - 1, 1e-3 * wall);
}

TEST(RadialFlow, aSphereFallsAlongItsPressure)
{
    RadialFlowDef def;
    def.cells = 10;
    def.initial = [](double r) { return FlowState{1, 0, 1 + r}; };
    RadialFlow flow(def);
    flow.advanceTo(1e-6);
    for (double r = 0.25; r < 0.8; r += 0.1)
        EXPECT_NEAR(flow.at(r).velocity / 1e-6, -1, 0.06) << r;
}

TEST(RadialFlow, aFreeSurfaceEscapesNoFasterThanIntoVacuum)
{
    RadialFlowDef def;
    def.spherical = false;
    def.outerWall = false;
    def.cells = 400;
    def.initial = [](double) { return FlowState{1, 0, 1}; };
    RadialFlow flow(def);
    flow.advanceTo(0.1);
    const double limit = 2 * std::sqrt(1.4) / 0.4;
    EXPECT_LT(flow.radius() - 1, 0.1 * limit);
    EXPECT_GT(flow.radius() - 1, 0.5 * 0.1 * limit);
}

} // namespace
} // namespace fx::sim
