#include "tests/simulation/dynamics/gas_stage.h"

#include <gtest/gtest.h>

using namespace fx;
using namespace fx::test;
using namespace fx::sim;

namespace {
GasParticle warm(const glm::dvec3& position, const glm::dvec3& velocity = glm::dvec3(0.0))
{
    return {position, velocity, 1.0, 1.0};
}
} // namespace

TEST(GasDynamics, theDensityOfALatticeIsOne)
{
    GasStage<double> stage(periodicBox(8), lattice(8, 1.0));
    for (uint32_t id = 0; id < 512; ++id)
        ASSERT_NEAR(stage.gas.densityOf(id), 1.0, 0.02);
    EXPECT_NEAR(stage.gas.pressureOf(5), 2.0 / 3.0 * stage.gas.densityOf(5), 1e-11);
    EXPECT_NEAR(stage.before.thermal, 1.0, 1e-6);
    EXPECT_NEAR(stage.before.mass, 1.0, 1e-12);
}

TEST(GasDynamics, idsStayWithTheirParticles)
{
    std::vector<GasParticle> particles = lattice(8, 1.0);
    for (size_t i = 0; i < particles.size(); ++i)
        particles[i].mass *= 1.0 + 1e-6 * double(i);
    GasStage<double> stage(periodicBox(8), particles);
    stage.advance(0.05);
    for (uint32_t id = 0; id < 512; ++id) {
        ASSERT_EQ(stage.gas.particle(id).mass, particles[id].mass);
        ASSERT_LT(length(stage.gas.particle(id).position - particles[id].position), 0.01);
        ASSERT_EQ(stage.gas.view().id[stage.gas.placeOf(id)], id);
    }
}

TEST(GasDynamics, listsThatServeSeveralStepsMissNobody)
{
    // Slow shear over many steps; then the density of all as a particle computes it that has just been added.
    GasDynamicsDef def = periodicBox(10);
    def.viscosity = {0.0, 0.0, 0.1, 0.0, 0.0, false};
    std::vector<GasParticle> particles = lattice(10, 1.0);
    for (GasParticle& particle : particles)
        particle.velocity.x = 0.12 * std::sin(2.0 * 3.14159265358979 * particle.position.y);
    GasStage<double> stage(def, particles);
    const AdvanceReport report = stage.advance(2.0);
    EXPECT_LT(report.searches * 2, report.subSteps); // lists do serve several steps
    for (uint32_t id = 0; id < particles.size(); ++id)
        particles[id] = stage.gas.particle(id);
    const GasStage<double> fresh(def, particles);
    for (uint32_t id = 0; id < particles.size(); ++id)
        ASSERT_NEAR(stage.gas.densityOf(id), fresh.gas.densityOf(id), 1e-9) << id;
}

TEST(GasDynamics, isolatedParticlesFlyStraight)
{
    for (const double distance : {1.0, 1e3, 1e8}) {
        GasDynamicsDef def;
        def.capacity = 3;
        def.largestSupport = 0.4; // below the distances: no pairs
        const std::vector<GasParticle> particles{
            warm({0, 0, 0}, {1, 2, 3}), warm({distance, 0, 0}, {1, 0, 0}), warm({0, distance, 0}, {0, 1, 0})};
        GasStage<double> stage(def, particles);
        for (int i = 0; i < 10; ++i)
            stage.advance(0.1);
        for (uint32_t id = 0; id < 3; ++id) {
            const glm::dvec3 want = particles[id].position + particles[id].velocity;
            EXPECT_LE(length(stage.gas.particle(id).position - want), 1e-12 * std::max(distance, 4.0));
            EXPECT_EQ(stage.gas.supportOf(id), 0.4);
            EXPECT_NEAR(stage.gas.particle(id).energy, 1.0, 1e-12); // no neighbor, no work
        }
    }
}

TEST(GasDynamics, aLoneParticleOfOpenBoundsHasAFiniteSupport)
{
    GasDynamicsDef def;
    def.capacity = 2;
    GasStage<float> stage(def, {warm({0, 0, 0}), warm({1e6, 0, 0})});
    stage.advance(1.0);
    EXPECT_TRUE(std::isfinite(stage.gas.supportOf(0)));
    EXPECT_GT(stage.gas.densityOf(0), 0.0);
}

TEST(GasDynamics, gravityAcceleratesEverybodyAlike)
{
    GasDynamicsDef def;
    def.capacity = 64;
    def.gravity = {0, 0, -10};
    std::vector<GasParticle> particles;
    for (GasParticle particle : lattice(4, 0.0))
        particles.push_back(particle);
    GasStage<double> stage(def, particles);
    stage.advance(2.0);
    for (uint32_t id = 0; id < 64; ++id) {
        ASSERT_NEAR(stage.gas.particle(id).velocity.z, -20.0, 1e-9);
        ASSERT_NEAR(stage.gas.particle(id).position.z, particles[id].position.z - 20.0, 1e-9);
    }
    EXPECT_NEAR(stage.gas.totals().energy(), stage.before.energy(), 1e-9);
}

TEST(GasDynamics, aBallExpandsIntoVacuumNoFasterThanItCan)
{
    // Free expansion: the front moves with at most 2 c / (gamma - 1); almost all heat becomes motion.
    GasDynamicsDef def = periodicBox(12);
    def.domain = Domain{};
    def.state.gamma = 1.4;
    std::vector<GasParticle> particles;
    for (const GasParticle& particle : lattice(12, 1.0))
        if (length(particle.position - glm::dvec3(0.5)) < 0.5)
            particles.push_back(particle);
    GasStage<float> stage(def, particles);
    stage.advance(2.0);
    const double sound = std::sqrt(1.4 * 0.4);
    double fastest = 0;
    for (uint32_t id = 0; id < stage.gas.count(); ++id)
        fastest = std::max(fastest, length(stage.gas.particle(id).velocity));
    EXPECT_LE(fastest, 1.05 * 2.0 * sound / 0.4);
    EXPECT_GE(fastest, 2.0 * sound);
    EXPECT_GE(stage.gas.totals().kinetic, 0.7 * stage.before.energy());
    EXPECT_LE(std::abs(stage.energyError()), 2e-3);
}

TEST(GasDynamics, heatGoesInExactly)
{
    GasStage<double> stage(periodicBox(8), lattice(8, 1.0));
    stage.gas.inject(100, 0.25);
    EXPECT_NEAR(stage.gas.totals().energy() - stage.before.energy(), 0.25, 1e-12);
    stage.gas.inject(100, -0.25);
    EXPECT_NEAR(stage.gas.totals().energy() - stage.before.energy(), 0.0, 1e-12);
    stage.gas.setEnergy(100, 7.0);
    EXPECT_NEAR(stage.gas.particle(100).energy, 7.0, 1e-12);
}

TEST(GasDynamics, aReducedSpeedOfSoundAllowsLongerSteps)
{
    GasStage<float> stage(periodicBox(8), lattice(8, 1.0));
    stage.advance(1e-6); // the very first steps are short
    const double full = stage.gas.stepOf(0);
    stage.gas.setPressureScale(0.01);
    stage.gas.initialize(*stage.tasks);
    EXPECT_NEAR(stage.gas.stepOf(0), 10.0 * full, 0.2 * full);
    stage.gas.setPressureScale(1.0);
    stage.gas.initialize(*stage.tasks);
    EXPECT_NEAR(stage.gas.stepOf(0), full, 1e-3 * full);
}

TEST(GasDynamics, whatComesLaterIsPartOfTheGas)
{
    std::vector<GasParticle> particles = lattice(8, 1.0);
    const std::vector<GasParticle> late(particles.begin() + 500, particles.end());
    particles.resize(500);
    GasStage<double> stage(periodicBox(8), particles);
    ASSERT_TRUE(stage.gas.add(late).ok());
    stage.gas.initialize(*stage.tasks);
    for (uint32_t id = 0; id < 512; ++id)
        ASSERT_NEAR(stage.gas.densityOf(id), 1.0, 0.02) << id;
}
