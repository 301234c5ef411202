#include "tests/simulation/dynamics/gas_stage.h"

#include "simulation/sph/dynamics/boundary.h"

#include <gtest/gtest.h>

using namespace fx;
using namespace fx::test;
using namespace fx::sim;

TEST(Boundary, periodicPositionsComeInAtTheOtherSide)
{
    const BoundaryAxis<float> axis{AxisKind::Periodic, -1.0f, 3.0f, 4.0f};
    for (const float x : {-1.5f, 3.0f, 7.25f, -1e5f, std::nextafter(-1.0f, -2.0f)}) {
        float y = x;
        EXPECT_FALSE(bringBack(axis, y));
        EXPECT_GE(y, -1.0f);
        EXPECT_LT(y, 3.0f);
    }
    float y = 3.5f;
    bringBack(axis, y);
    EXPECT_EQ(y, -0.5f);
}

TEST(Boundary, wallsThrowBack)
{
    const BoundaryAxis<double> box{AxisKind::Reflecting, 0.0, 2.0, 2.0};
    double x = -0.5;
    EXPECT_TRUE(bringBack(box, x));
    EXPECT_EQ(x, 0.5);
    x = 4.5; // once at the far wall, once at the near one
    EXPECT_FALSE(bringBack(box, x));
    EXPECT_EQ(x, 0.5);
    x = 1e9;
    bringBack(box, x);
    EXPECT_EQ(x, 2.0);
}

TEST(Walls, aParticleBouncesForEver)
{
    GasDynamicsDef def;
    def.capacity = 1;
    def.largestSupport = 0.01;
    def.domain.axes[2] = AxisKind::Reflecting;
    def.domain.low.z = 0;
    def.domain.high.z = 1;
    GasStage<double> stage(def, {GasParticle{{0, 0, 0.25}, {0, 0, -1}, 1.0, 0.0}});
    stage.advance(0.5);
    EXPECT_NEAR(stage.gas.particle(0).position.z, 0.25, 1e-12);
    EXPECT_EQ(stage.gas.particle(0).velocity.z, 1.0);
    for (int i = 0; i < 100; ++i)
        stage.advance(0.1);
    EXPECT_NEAR(stage.gas.totals().kinetic, 0.5, 1e-12);
}

TEST(Walls, aBurstOnTheGroundIsHalfOfAFreeBurstOfTwiceTheEnergy)
{
    constexpr uint32_t n = 14; // supports stay below 0.39 of the half box
    std::vector<GasParticle> particles = lattice(n, 1e-2);
    heatNearest(particles, glm::dvec3(0.5), 32, 1.0);
    GasDynamicsDef def = periodicBox(n);
    GasStage<double> whole(def, particles);
    std::vector<GasParticle> upper;
    std::vector<uint32_t> ids;
    for (uint32_t i = 0; i < particles.size(); ++i)
        if (particles[i].position.z > 0.5) {
            upper.push_back(particles[i]);
            ids.push_back(i);
        }
    def.domain.axes[2] = AxisKind::Reflecting;
    def.domain.low.z = 0.5;
    GasStage<double> half(def, upper);
    EXPECT_NEAR(half.before.energy(), 0.5 * whole.before.energy(), 1e-9);
    whole.advance(0.01);
    half.advance(0.01);
    double worst = 0;
    for (uint32_t k = 0; k < ids.size(); ++k)
        worst = std::max(worst, length(half.gas.particle(k).position - whole.gas.particle(ids[k]).position));
    EXPECT_LE(worst, 2e-3 / n); // sums run in another order, supports within their tolerance
    EXPECT_NEAR(half.gas.totals().kinetic, 0.5 * whole.gas.totals().kinetic,
                1e-5 * whole.gas.totals().kinetic);
}
