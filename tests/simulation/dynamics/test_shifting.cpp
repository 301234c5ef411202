#include "tests/simulation/dynamics/gas_stage.h"

#include <gtest/gtest.h>

#include <cstring>

using namespace fx;
using namespace fx::test;
using namespace fx::sim;

namespace {

/// A ball of gas in the open whose particles stand anyhow.
std::vector<GasParticle> disorder()
{
    std::vector<GasParticle> particles;
    uint64_t random = 3;
    for (GasParticle particle : lattice(12, 1.0)) {
        for (int a = 0; a < 3; ++a) {
            random = random * 6364136223846793005u + 1442695040888963407u;
            particle.position[a] += 1.5 / 12 * (double(random >> 40) / double(1 << 24) - 0.5);
        }
        particle.velocity = {1.0, 2.0 * particle.position.x, 0.0};
        if (length(particle.position - glm::dvec3(0.5)) < 0.5)
            particles.push_back(particle);
    }
    return particles;
}

GasDynamicsDef openSpace()
{
    GasDynamicsDef def;
    def.capacity = 2000;
    return def;
}

double medianNearest(const GasDynamics<float>& gas)
{
    std::vector<double> nearest;
    for (uint32_t i = 0; i < gas.count(); ++i) {
        double least = 1e30;
        for (uint32_t j = 0; j < gas.count(); ++j)
            if (j != i)
                least = std::min(least, length(gas.particle(i).position - gas.particle(j).position));
        nearest.push_back(least * 12);
    }
    std::nth_element(nearest.begin(), nearest.begin() + std::ptrdiff_t(nearest.size() / 2), nearest.end());
    return nearest[nearest.size() / 2];
}

glm::dvec3 centerOf(const GasDynamics<float>& gas)
{
    glm::dvec3 sum(0.0);
    for (uint32_t i = 0; i < gas.count(); ++i)
        sum += gas.particle(i).position / double(gas.count());
    return sum;
}

} // namespace

TEST(Shifting, spreadsParticlesEvenly)
{
    GasStage<float> stage(openSpace(), disorder());
    EXPECT_LT(medianNearest(stage.gas), 0.7);
    for (int i = 0; i < 40; ++i) {
        stage.gas.shift(0.5, 0.05, *stage.tasks);
        stage.gas.edited();
        stage.gas.initialize(*stage.tasks);
    }
    EXPECT_GT(medianNearest(stage.gas), 0.85);
}

TEST(Shifting, changesNeitherMassNorMotionAndMovesNobodyFar)
{
    constexpr double kLongest = 0.05;
    GasStage<float> stage(openSpace(), disorder());
    std::vector<GasParticle> before;
    for (uint32_t id = 0; id < stage.gas.count(); ++id)
        before.push_back(stage.gas.particle(id));
    stage.gas.shift(0.5, kLongest, *stage.tasks);
    double farthest = 0;
    for (uint32_t id = 0; id < stage.gas.count(); ++id) {
        const GasParticle after = stage.gas.particle(id);
        EXPECT_EQ(after.velocity, before[id].velocity);
        EXPECT_EQ(after.mass, before[id].mass);
        const double spacing = std::cbrt(after.mass / stage.gas.densityOf(id));
        const double way = length(after.position - before[id].position) / spacing;
        EXPECT_LE(way, 1.001 * kLongest);
        farthest = std::max(farthest, way);
    }
    EXPECT_GT(farthest, 0.99 * kLongest);
}

TEST(Shifting, doesNotBlowUpTheCloud)
{
    GasStage<float> stage(openSpace(), disorder());
    const auto radius = [&] {
        const glm::dvec3 center = centerOf(stage.gas);
        double sum = 0;
        for (uint32_t id = 0; id < stage.gas.count(); ++id)
            sum += length(stage.gas.particle(id).position - center) / stage.gas.count();
        return sum;
    };
    const double before = radius();
    const glm::dvec3 center = centerOf(stage.gas);
    for (int i = 0; i < 60; ++i) {
        stage.gas.shift(0.5, 0.05, *stage.tasks);
        stage.gas.edited();
        stage.gas.initialize(*stage.tasks);
    }
    EXPECT_NEAR(radius(), before, 0.06 * before);
    EXPECT_LT(length(centerOf(stage.gas) - center), 0.02);
}

TEST(Shifting, isTheSameAfterARestore)
{
    GasStage<float> stage(openSpace(), disorder());
    stage.advance(0.01);
    std::vector<std::byte> bytes;
    stage.gas.save(bytes);
    GasDynamics<float> other(openSpace(), std::pmr::get_default_resource());
    ASSERT_TRUE(other.restore(bytes).ok());
    for (GasDynamics<float>* gas : {&stage.gas, &other}) {
        gas->shift(0.5, 0.05, *stage.tasks);
        gas->nudged(1.0, *stage.tasks);
        ASSERT_TRUE(gas->advance(0.01, *stage.tasks).ok());
    }
    EXPECT_EQ(stage.gas.hash(), other.hash());
}
