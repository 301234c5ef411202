// Light in a network of particles: furnace, balance of energy, bounds, symmetry, particles that overlap or
// lie behind each other, same bits.
#include "foundation/random/philox.h"
#include "rendering/network/particle_network.h"
#include "shaders/formulas/formula.h"
#include "tests/foundation/real_threads.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

using namespace fx;
using namespace fx::render;
using namespace fx::test;

namespace {

constexpr double kSphere = 4.0 * std::numbers::pi;

const ParticleNetworkSettings kForms[] = {
    {32, 32, 0.5, 0.0}, {32, 32, 0.0, 0.0}, {64, 32, 0.5, 0.8}, {64, 24, 0.0, 0.8}, {128, 16, 1.0, -0.4}};

double chance(uint64_t seed, size_t i, uint32_t k)
{
    return double(base::toUnitFloat(base::philox({uint32_t(i), k, 0, 0}, seed)[0]));
}

/// Particles that overlap, of optical depths from 0.01 to 10 through their middles.
std::vector<NetworkParticle> cloud(uint64_t seed, size_t count, double mostAlbedo)
{
    std::vector<NetworkParticle> particles;
    for (size_t i = 0; i < count; ++i) {
        NetworkParticle p;
        p.center = {chance(seed, i, 0), chance(seed, i, 1), chance(seed, i, 2)};
        p.radius = 0.08 + 0.2 * chance(seed, i, 3);
        p.crossSection = p.radius * p.radius * std::pow(10.0, 3.0 * chance(seed, i, 4) - 2.0);
        p.albedo = mostAlbedo * (chance(seed, i, 5) < 0.5 ? 1.0 : chance(seed, i, 6));
        p.emission = chance(seed, i, 7);
        particles.push_back(p);
    }
    return particles;
}

struct Built
{
    ParticleNetwork network;
    std::unique_ptr<base::TaskRunner> tasks = base::makeSerialRunner();

    Built(std::span<const NetworkParticle> particles, const ParticleNetworkSettings& settings)
    {
        EXPECT_TRUE(network.build(particles, settings, *tasks).ok());
    }
    void setEverywhere(float radiance)
    {
        EXPECT_TRUE(network.setEnvironment(std::vector<float>(network.directions().size(), radiance)).ok());
    }
    SweepReport toRest(double tolerance = 1e-8, int iterations = 2000)
    {
        return network.iterate({iterations, 3, tolerance}, *tasks);
    }
};

} // namespace

TEST(ParticleNetwork, inAFurnaceIsOneEverywhere)
{
    for (const ParticleNetworkSettings& form : kForms) {
        std::vector<NetworkParticle> particles = cloud(1, 60, 1.0);
        for (NetworkParticle& p : particles) {
            p.albedo = 1.0;
            p.emission = 0.0;
        }
        Built built(particles, form);
        built.setEverywhere(1.0f);
        built.toRest();
        for (size_t i = 0; i < particles.size(); ++i) {
            ASSERT_NEAR(built.network.meanRadiance(i), 1.0, 1e-5)
                << form.directions << " " << form.anisotropy;
            for (const glm::dvec3& eye : {glm::dvec3(0.6, 0.0, 0.8), glm::dvec3(0.0, -1.0, 0.0)})
                ASSERT_NEAR(built.network.scattered(i, eye), 1.0, 1e-4) << "and so the eye has it";
        }
    }
}

TEST(ParticleNetwork, ofAMediumInEquilibriumWithItsWallsIsThatOfTheWalls)
{
    for (const ParticleNetworkSettings& form : kForms) {
        std::vector<NetworkParticle> particles = cloud(2, 50, 0.98);
        for (NetworkParticle& p : particles)
            p.emission = 3.0 * (1.0 - p.albedo); // Kirchhoff
        Built built(particles, form);
        built.setEverywhere(3.0f);
        built.toRest();
        for (size_t i = 0; i < particles.size(); ++i)
            ASSERT_NEAR(built.network.meanRadiance(i), 3.0, 3e-5);
    }
}

TEST(ParticleNetwork, losesAndMakesNoLight)
{
    for (const ParticleNetworkSettings& form : kForms)
        for (const uint64_t seed : {3u, 4u, 5u}) {
            Built built(cloud(seed, 80, 0.99), form);
            built.setEverywhere(0.2f);
            built.network.addDirect(7, {0.0, -0.6, 0.8}, 5.0);
            built.toRest();
            const NetworkEnergy energy = built.network.energy(*built.tasks);
            EXPECT_GT(energy.emitted, 0.1);
            EXPECT_NEAR((energy.absorbed + energy.escaped) / energy.emitted, 1.0, 1e-5);
        }
}

TEST(ParticleNetwork, firstScatteringOfABeamHasItsPower)
{
    // Of a beam of irradiance E a particle scatters albedo * sigma * E, in whatever direction it travels.
    NetworkParticle particle{{0.2, 0.1, -0.3}, 0.4, 1e-6, 0.7, 0.0};
    for (const glm::dvec3& travel : {glm::dvec3(0.0, 0.0, 1.0), glm::dvec3(0.48, 0.6, -0.64)}) {
        Built built(std::span(&particle, 1), {64, 32, 0.5, 0.8});
        built.network.addDirect(0, travel, 5.0);
        const NetworkEnergy energy = built.network.energy(*built.tasks);
        EXPECT_NEAR(energy.emitted / (0.7 * 1e-6 * 5.0), 1.0, 1e-5);
        EXPECT_NEAR(energy.escaped / energy.emitted, 1.0, 1e-4) << "it is thin";
    }
}

TEST(ParticleNetwork, aParticleLetsThroughWhatItsDepthLeaves)
{
    // A black ball in light from outside: what passes its disc, over all rays by the rule of midpoints.
    for (const double crossSection : {0.05, 0.5, 5.0}) {
        NetworkParticle ball{{0.0, 0.0, 0.0}, 0.5, crossSection, 0.0, 0.0};
        Built built(std::span(&ball, 1), {32, 128, 0.5, 0.0});
        built.setEverywhere(1.0f);
        const NetworkEnergy energy = built.network.energy(*built.tasks);
        double taken = 0.0;
        constexpr int kRings = 20000;
        for (int i = 0; i < kRings; ++i) {
            const double h = 0.5 * (i + 0.5) / kRings, q = 1.0 - 4.0 * h * h;
            const double depth = 3.5 / std::numbers::pi * crossSection / 0.25 * std::pow(q, 2.5);
            taken += 2.0 * std::numbers::pi * h * (0.5 / kRings) * -std::expm1(-depth);
        }
        EXPECT_NEAR(energy.absorbed / (kSphere * taken), 1.0, 2e-3) << crossSection;
    }
}

TEST(ParticleNetwork, lightOfAParticleInAnotherIsThatOfTheOtherInIt)
{
    for (const ParticleNetworkSettings& form : kForms) {
        std::vector<NetworkParticle> particles = cloud(6, 40, 0.9);
        for (NetworkParticle& p : particles)
            p.emission = 0.0;
        const size_t a = 5, b = 31;
        const auto lightIn = [&](size_t to, size_t from) {
            std::vector<NetworkParticle> lit = particles;
            lit[from].emission = 1.0; // its power goes with its cross section
            Built built(lit, form);
            built.toRest();
            return built.network.meanRadiance(to) / particles[from].crossSection;
        };
        const double there = lightIn(a, b), back = lightIn(b, a);
        EXPECT_GT(there, 0.0);
        EXPECT_NEAR(there / back, 1.0, 2e-5) << form.directions;
    }
}

TEST(ParticleNetwork, particlesAtOnePlaceAreOneOfAllOfThem)
{
    // A dense ball beside another: as one particle, as four that share its cross section, and as soot and
    // fire.
    const NetworkParticle beside{{0.9, 0.0, 0.0}, 0.5, 0.3, 0.8, 0.0};
    const auto lightBeside = [&](std::vector<NetworkParticle> particles, double segment) {
        particles.push_back(beside);
        Built built(particles, {64, 48, segment, 0.5});
        built.toRest();
        return built.network.meanRadiance(particles.size() - 1);
    };
    const auto ball = [](double crossSection, double albedo, double emission) {
        return NetworkParticle{{0.0, 0.0, 0.0}, 0.5, crossSection, albedo, emission};
    };
    const std::vector<NetworkParticle> parts(4, ball(1.0, 0.95, 1.0));
    EXPECT_NEAR(lightBeside(parts, 0.5) / lightBeside({ball(4.0, 0.95, 1.0)}, 0.5), 1.0, 1e-5);
    const std::vector<NetworkParticle> fire{ball(4.0, 0.0, 0.0), ball(4.0, 0.0, 1.0)};
    const double mixed = lightBeside({ball(8.0, 0.0, 0.5)}, 0.5);
    EXPECT_NEAR(lightBeside(fire, 0.5) / mixed, 1.0, 1e-5)
        << "of soot and fire at one place the mean is seen";
    EXPECT_GT(std::abs(lightBeside(fire, 0.0) / mixed - 1.0), 0.05)
        << "whole particles hide each other: this is what segments are for";
}

TEST(ParticleNetwork, smokeThatScattersForwardIsBrighterBeforeALightThanBehindIt)
{
    const auto ratio = [](double anisotropy) {
        const NetworkParticle particles[] = {{{0.0, 0.0, 0.0}, 0.2, 0.05, 0.0, 1.0},
                                             {{0.0, 0.0, 1.0}, 0.3, 0.05, 0.9, 0.0}};
        Built built(particles, {128, 48, 0.5, anisotropy});
        built.toRest();
        return built.network.scattered(1, {0.0, 0.0, 1.0}) / built.network.scattered(1, {0.0, 0.0, -1.0});
    };
    EXPECT_NEAR(ratio(0.0), 1.0, 0.01);
    EXPECT_GT(ratio(0.5), 5.0);
}

TEST(ParticleNetwork, theBoundHoldsAfterEachIteration)
{
    for (const uint64_t seed : {8u, 9u, 10u})
        for (const double albedo : {0.5, 0.9, 0.99}) {
            const std::vector<NetworkParticle> particles = cloud(seed, 40, albedo);
            const ParticleNetworkSettings form{32, 24, 0.5, 0.6};
            Built exact(particles, form), built(particles, form);
            exact.toRest(1e-9, 5000);
            for (int i = 0; i < 12; ++i) {
                const SweepReport report = built.network.iterate({1, i < 6 ? 0 : 3, 0.0}, *built.tasks);
                double error = 0.0, scattered = 0.0;
                for (size_t p = 0; p < particles.size(); ++p) {
                    const double weight = particles[p].albedo * particles[p].crossSection;
                    error += weight * std::abs(built.network.meanRadiance(p) - exact.network.meanRadiance(p));
                    scattered += weight * exact.network.meanRadiance(p);
                }
                ASSERT_LE(error / scattered, report.bound * 1.5 + 1e-6) << i << " of albedo " << albedo;
            }
        }
}

TEST(ParticleNetwork, restsUntilLightChanges)
{
    Built built(cloud(11, 40, 0.9), kForms[0]);
    EXPECT_GT(built.toRest(1e-4).sweeps, 3);
    EXPECT_EQ(built.toRest(1e-4).sweeps, 0);
    built.network.addDirect(3, {0.0, 0.0, 1.0}, 1.0);
    EXPECT_GT(built.toRest(1e-4).sweeps, 0);
}

TEST(ParticleNetwork, hasTheSameBitsForAnyNumberOfWorkers)
{
    const std::vector<NetworkParticle> particles = cloud(12, 150, 0.95);
    const auto light = [&](base::TaskRunner& tasks) {
        ParticleNetwork network;
        EXPECT_TRUE(network.build(particles, {32, 24, 0.5, 0.6}, tasks).ok());
        network.iterate({7, 2, 0.0}, tasks);
        std::vector<double> all;
        for (size_t p = 0; p < particles.size(); ++p)
            all.push_back(network.meanRadiance(p));
        return all;
    };
    const RealThreads many(16);
    const std::vector<double> one = light(*base::makeSerialRunner());
    for (const uint32_t workers : {2u, 3u, 7u, 16u}) {
        const auto runner = base::makeTbbRunner(workers);
        EXPECT_EQ(light(*runner), one) << workers;
    }
}

TEST(ParticleNetwork, particlesBetweenTheLinesCount)
{
    // Lines are 0.5 m apart, the small particle has a radius of a centimeter.
    NetworkParticle particles[] = {{{1.0, 0.0, 0.0}, 1.0, 1e-9, 0.0, 0.0},
                                   {{0.1, 0.07, 0.03}, 0.01, 1e-6, 0.0, 1.0}};
    Built built(particles, {32, 4, 0.5, 0.0});
    const NetworkEnergy energy = built.network.energy(*built.tasks);
    EXPECT_NEAR(energy.emitted / (kSphere * 1e-6), 1.0, 1e-5);
    EXPECT_NEAR(energy.escaped / energy.emitted, 1.0, 1e-3);
}

TEST(ParticleNetwork, withoutParticlesHasNoLight)
{
    Built built({}, {});
    built.setEverywhere(1.0f);
    EXPECT_TRUE(built.toRest().isConverged);
    const NetworkEnergy energy = built.network.energy(*built.tasks);
    EXPECT_EQ(energy.emitted, 0.0);
    EXPECT_EQ(energy.escaped, 0.0);
    EXPECT_EQ(built.network.links(), 0u);
}

TEST(ParticleNetwork, refusesWhatItCannotHold)
{
    constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
    const auto tasks = base::makeSerialRunner();
    ParticleNetwork network;
    NetworkParticle good{{0.0, 0.0, 0.0}, 1.0, 1.0, 0.5, 0.0};
    const auto code = [&](const NetworkParticle& p, const ParticleNetworkSettings& settings) {
        return network.build(std::span(&p, 1), settings, *tasks).code();
    };
    EXPECT_EQ(code(good, {}), base::Code::Ok);
    for (const ParticleNetworkSettings& bad : {ParticleNetworkSettings{7, 48, 0.5, 0.0},
                                               {4, 48, 0.5, 0.0},
                                               {514, 48, 0.5, 0.0},
                                               {64, 3, 0.5, 0.0},
                                               {64, 513, 0.5, 0.0},
                                               {64, 48, 0.05, 0.0},
                                               {64, 48, kNan, 0.0},
                                               {64, 48, 0.5, 0.95},
                                               {64, 48, 0.5, kNan}})
        EXPECT_EQ(code(good, bad), base::Code::InvalidArgument);
    for (double NetworkParticle::*member : {&NetworkParticle::radius, &NetworkParticle::crossSection,
                                            &NetworkParticle::albedo, &NetworkParticle::emission})
        for (const double value : {-1.0, kNan, std::numeric_limits<double>::infinity()}) {
            NetworkParticle bad = good;
            bad.*member = value;
            EXPECT_EQ(code(bad, {}), base::Code::InvalidArgument) << value;
        }
    for (int axis = 0; axis < 3; ++axis)
        for (const double value : {kNan, -2e9, std::numeric_limits<double>::infinity()}) {
            NetworkParticle bad = good;
            bad.center[axis] = value;
            EXPECT_EQ(code(bad, {}), base::Code::InvalidArgument) << value;
        }
    for (double NetworkParticle::*member : {&NetworkParticle::radius, &NetworkParticle::crossSection}) {
        NetworkParticle nothing = good;
        nothing.*member = 0.0;
        const base::Status status = network.build(std::span(&nothing, 1), {}, *tasks);
        EXPECT_EQ(status.code(), base::Code::InvalidArgument);
        EXPECT_NE(status.message().find("above 0"), std::string::npos) << status.message();
    }
    const std::vector<NetworkParticle> many(ParticleNetwork::kMaxParticles + 1, good);
    EXPECT_EQ(network.build(many, {}, *tasks).code(), base::Code::TooLarge);
    const std::vector<NetworkParticle> dense(1000, good);
    EXPECT_EQ(network.build(dense, {512, 512, 0.5, 0.0}, *tasks).code(), base::Code::TooLarge);
    EXPECT_EQ(network.directions().size(), 64u) << "it is as it was";
    EXPECT_EQ(network.setEnvironment(std::vector<float>(63, 1.0f)).code(), base::Code::InvalidArgument);
    EXPECT_EQ(network.setEnvironment(std::vector<float>(64, -1.0f)).code(), base::Code::InvalidArgument);
}

TEST(ParticleNetwork, takesNoMoreBytesThanItsBound)
{
    const auto tasks = base::makeSerialRunner();
    for (const double segment : {0.0, 0.1, 0.5, 10.0})
        for (const double radius : {1e-3, 0.1, 0.7}) {
            std::vector<NetworkParticle> particles;
            for (int i = 0; i < 60; ++i) // of unequal size
                particles.push_back({{std::sin(i), std::cos(3 * i), std::sin(7 * i)},
                                     radius * (0.5 + 0.025 * i),
                                     radius * radius,
                                     0.9,
                                     0.0});
            const ParticleNetworkSettings settings{12, 40, segment, 0.0};
            ParticleNetwork network;
            ASSERT_TRUE(network.build(particles, settings, *tasks));
            EXPECT_LE(double(network.bytes()), ParticleNetwork::mostBytes(particles, settings))
                << segment << " " << radius;
        }
    const std::vector<NetworkParticle> dense(2000, {glm::dvec3(0.0), 1.0, 1.0, 0.9, 0.0});
    EXPECT_GT(ParticleNetwork::mostBytes(dense, {32, 64, 0.1, 0.0}), ParticleNetwork::kMaxBytes);
    ParticleNetwork network;
    const base::Status status = network.build(dense, {32, 64, 0.1, 0.0}, *tasks);
    EXPECT_EQ(status.code(), base::Code::TooLarge);
    EXPECT_NE(status.message().find("2048"), std::string::npos) << status.message();
}
