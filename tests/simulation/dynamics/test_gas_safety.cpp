#include "tests/simulation/dynamics/gas_stage.h"

#include <gtest/gtest.h>

#include <limits>

using namespace fx;
using namespace fx::test;
using namespace fx::sim;

namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

bool everythingIsFinite(const GasTotals& totals)
{
    return std::isfinite(totals.energy()) && std::isfinite(totals.momentumScale);
}

} // namespace

TEST(GasSafety, refusesParticlesThatAreNot)
{
    GasStage<float> stage(periodicBox(4),
                          std::vector<GasParticle>(1, GasParticle{{0.5, 0.5, 0.5}, {}, 1.0, 1.0}));
    const uint64_t hash = stage.gas.hash();
    std::vector<GasParticle> wrong;
    for (const double value : {kNaN, kInf, -kInf, std::numeric_limits<double>::max(), -1.0})
        for (int field = 0; field < 8; ++field) {
            GasParticle particle{{0.5, 0.5, 0.5}, {}, 1.0, 1.0};
            if (field < 3)
                particle.position[field] = value;
            else if (field < 6 && value != -1.0)
                particle.velocity[field - 3] = value;
            else if (field == 6)
                particle.mass = value;
            else if (field == 7)
                particle.energy = value;
            else
                continue;
            wrong.push_back(particle);
        }
    for (const double mass : {0.0, -0.0, 1e-310, 1e-40})
        wrong.push_back({{0.5, 0.5, 0.5}, {}, mass, 1.0});
    for (const GasParticle& particle : wrong) {
        const std::vector<GasParticle> batch{{{0.2, 0.2, 0.2}, {}, 1.0, 1.0}, particle};
        EXPECT_EQ(stage.gas.add(batch).code(), base::Code::InvalidArgument);
    }
    EXPECT_EQ(stage.gas.add(std::vector<GasParticle>(64, GasParticle{{0.5, 0.5, 0.5}, {}, 1.0, 1.0})).code(),
              base::Code::Capacity);
    EXPECT_EQ(stage.gas.count(), 1u);
    EXPECT_EQ(stage.gas.hash(), hash);
}

TEST(GasSafety, refusesDefinitionsOutOfRange)
{
    EXPECT_TRUE(checkGasDynamicsDef(periodicBox(4)).ok());
    GasDynamicsDef def = periodicBox(4);
    def.capacity = 0;
    EXPECT_FALSE(checkGasDynamicsDef(def).ok());
    def = periodicBox(4);
    def.state.gamma = 1.0;
    EXPECT_FALSE(checkGasDynamicsDef(def).ok());
    def = periodicBox(4);
    def.courant = kNaN;
    EXPECT_FALSE(checkGasDynamicsDef(def).ok());
    def = periodicBox(4);
    def.domain.high.y = kInf;
    EXPECT_FALSE(checkGasDynamicsDef(def).ok());
    def = periodicBox(4);
    def.gravity.z = kNaN;
    EXPECT_FALSE(checkGasDynamicsDef(def).ok());
}

TEST(GasSafety, noTimeChangesNothingAndBadTimesAreRefused)
{
    auto stage = pointBlast<float>(8, periodicBox(8));
    stage.advance(0.01);
    const uint64_t hash = stage.gas.hash();
    EXPECT_EQ(stage.advance(0.0).subSteps, 0u);
    for (const double seconds : {-1.0, -1e-300, kNaN, kInf, -kInf})
        EXPECT_EQ(stage.gas.advance(seconds, *stage.tasks).status().code(), base::Code::InvalidArgument);
    EXPECT_EQ(stage.gas.hash(), hash);
}

TEST(GasSafety, anyFrameTimeIsSafeAndTheDebtIsReported)
{
    for (const StepScheme steps : {StepScheme::Global, StepScheme::Block})
        for (const double seconds : {1e-12, 1.0 / 60, 1.0, 1e30}) {
            GasDynamicsDef def = periodicBox(8, steps);
            def.maxSubSteps = 25;
            auto stage = pointBlast<float>(8, def, 1e-2);
            for (int frame = 0; frame < 4; ++frame) {
                const AdvanceReport report = stage.advance(seconds);
                EXPECT_LE(report.subSteps, 25u);
                EXPECT_NEAR(report.seconds + report.debt, seconds, 1e-9 * seconds);
                EXPECT_GE(report.debt, 0.0);
            }
            EXPECT_TRUE(everythingIsFinite(stage.gas.totals()));
            EXPECT_LE(std::abs(stage.energyError()), 0.03) << seconds;
        }
}

TEST(GasSafety, everybodyStopsAtTheSameTimeWhenTheBudgetIsUsedUp)
{
    // A lone particle takes one step for the frame; the blast beside it ends the frame early.
    GasDynamicsDef def = periodicBox(8, StepScheme::Block);
    def.domain = Domain{};
    def.capacity += 1;
    def.largestSupport = 1.0;
    def.maxSubSteps = 3;
    std::vector<GasParticle> particles = lattice(8, 1e-2);
    heatNearest(particles, glm::dvec3(0.5), 32, 1.0);
    particles.push_back({{50, 0, 0}, {2, 0, 0}, 1e-3, 1.0});
    GasStage<double> stage(def, particles);
    const AdvanceReport report = stage.advance(1.0);
    EXPECT_GT(report.debt, 0.5);
    EXPECT_NEAR(stage.gas.particle(512).position.x, 50.0 + 2.0 * report.seconds, 1e-12);
}

TEST(GasSafety, framesOfChangingLengthAreOne)
{
    auto stage = pointBlast<double>(8, periodicBox(8), 1e-2);
    for (int i = 0; i < 10; ++i)
        stage.advance(i % 2 ? 1e-5 : 5e-3);
    EXPECT_LE(std::abs(stage.energyError()), 2e-3);
}

TEST(GasSafety, coincidentParticlesStayFinite)
{
    for (const uint32_t count : {2u, 32u, 500u}) {
        GasDynamicsDef def;
        def.capacity = count;
        def.steps = StepScheme::Global;
        def.smallestSupport = 1e-3;
        def.largestSupport = 1.0;
        def.maxSubSteps = 200;
        GasStage<float> stage(def, std::vector<GasParticle>(count, GasParticle{{1, 2, 3}, {}, 0.01, 1.0}));
        stage.advance(0.1);
        const GasTotals totals = stage.gas.totals();
        EXPECT_TRUE(everythingIsFinite(totals));
        EXPECT_LE(length(totals.momentum), 1e-5 * totals.momentumScale);
    }
}

TEST(GasSafety, outliersDoNotUpsetTheSupports)
{
    for (const double far : {1.0, 1e4, 1e8}) {
        GasDynamicsDef def = periodicBox(6);
        def.domain = Domain{};
        def.capacity += 3;
        std::vector<GasParticle> particles = lattice(6, 1.0);
        for (int a = 0; a < 3; ++a) {
            GasParticle outlier = particles[0];
            outlier.position[a] = far;
            particles.push_back(outlier);
        }
        GasStage<float> stage(def, particles);
        stage.advance(0.2);
        EXPECT_TRUE(everythingIsFinite(stage.gas.totals()));
        for (uint32_t id = 0; id < stage.gas.count(); ++id)
            ASSERT_TRUE(stage.gas.densityOf(id) > 0 && std::isfinite(stage.gas.supportOf(id)));
    }
}

TEST(GasSafety, coldGasAndHugeEnergiesStayFinite)
{
    GasStage<float> cold(periodicBox(6), lattice(6, 0.0));
    cold.advance(1.0);
    EXPECT_TRUE(everythingIsFinite(cold.gas.totals()));

    std::vector<GasParticle> particles = lattice(6, 0.0);
    particles[100].energy = 1e18;
    GasDynamicsDef def = periodicBox(6);
    def.maxSubSteps = 50;
    GasStage<float> hot(def, particles);
    hot.advance(1.0);
    EXPECT_TRUE(everythingIsFinite(hot.gas.totals()));
}
