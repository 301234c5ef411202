/// Optical depths in closed form and their inverse, and that no estimator changes what a path finds on
/// average.

#include "rendering/reference/blob_medium/blob_medium.h"
#include "rendering/reference/path/path_integrator.h"

#include "tests/rendering/reference/path/path_statistics.h"
#include "tests/rendering/reference/path/path_test_media.h"

#include <glm/geometric.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <numbers>

namespace fx::render {
namespace {

constexpr double kPi = std::numbers::pi;

/// From 3 m away through the blobs.
TraceRay someRay(uint32_t number)
{
    PathSampler sampler(21, 0, number);
    const double cosine = 1.0 - 2.0 * sampler.number();
    const glm::dvec3 from = 3.0 * PhaseFunction::around({0, 1, 0}, cosine, sampler.number());
    const glm::dvec3 to{sampler.number() - 0.5, sampler.number() - 0.5, sampler.number() - 0.5};
    return {from, glm::normalize(to - from)};
}

class PathDepth : public testing::Test
{
protected:
    PathDepth()
    {
        blobs_ = someBlobs(80, 0.25, {0.9, 0.8, 0.6}, 0.4);
        for (size_t i = 0; i < blobs_.size(); i += 7) { // hot, small and dense
            blobs_[i].source = glm::dvec3(8.0, 5.0, 2.0) * (1.0 + double(i % 3));
            blobs_[i].radius *= 0.5;
            blobs_[i].albedo = glm::dvec3(0.3);
            blobs_[i].anisotropy = 0.0;
        }
        medium_ = std::make_unique<BlobPathMedium>(blobs_, glm::dvec3(0.0), *tasks_);
    }

    std::unique_ptr<base::TaskRunner> tasks_ = base::makeSerialRunner();
    std::vector<MediumBlob> blobs_;
    std::unique_ptr<BlobPathMedium> medium_;
};

TEST_F(PathDepth, isTheIntegralOfTheExtinction)
{
    const auto way = medium_->depthWalk();
    const auto walk = medium_->walk();
    for (uint32_t number = 0; number < 200; ++number) {
        const TraceRay ray = someRay(number);
        way->start(ray, 1.1, 4.2);
        glm::dvec3 expected;
        for (const double to : {1.2, 2.5, 3.0, 4.2, 9.0}) {
            walk->opticalDepth(ray, 1.1, std::min(to, 4.2), expected);
            EXPECT_NEAR(way->depthTo(to), expected.x, 1e-12 * (1.0 + expected.x));
        }
        EXPECT_NEAR(way->depth(), expected.x, 1e-12 * (1.0 + expected.x));
    }
}

TEST_F(PathDepth, hasAnInverse)
{
    const auto way = medium_->depthWalk();
    uint32_t rays = 0;
    for (uint32_t number = 0; number < 200; ++number) {
        way->start(someRay(number), 0.0, 1e30);
        rays += way->depth() > 0.1;
        for (const double share : {0.0, 1e-9, 0.1, 0.5, 0.999, 1.0}) {
            const double depth = share * way->depth();
            EXPECT_NEAR(way->depthTo(way->parameterAt(depth)), depth, 1e-11 * (1.0 + depth));
        }
    }
    EXPECT_GT(rays, 100u);
}

TEST_F(PathDepth, meetsTheMediumThatSegmentsMeet)
{
    const auto way = medium_->depthWalk();
    const auto walk = medium_->walk();
    uint32_t compared = 0;
    for (uint32_t number = 0; number < 50; ++number) {
        const TraceRay ray = someRay(number);
        way->start(ray, 0.0, 6.0);
        walk->start(ray, 0.0, 6.0);
        for (MajorantSegment segment; walk->next(segment); ++compared) {
            const double t = 0.3 * segment.begin + 0.7 * segment.end;
            const MediumPoint expected = walk->at(t, 0.0), found = way->at(t, 0.0);
            EXPECT_NEAR(found.extinction.y, expected.extinction.y, 1e-9 * (1.0 + expected.extinction.y));
            EXPECT_NEAR(found.emission.y, expected.emission.y, 1e-9 * (1.0 + expected.emission.y));
        }
    }
    EXPECT_GT(compared, 500u);
}

TEST_F(PathDepth, oneMajorantIsAboveTheExtinctionEverywhereAndNotFarAbove)
{
    const double majorant = medium_->majorant();
    const BlobMedium independent = [&] {
        std::vector<Blob> list;
        for (const MediumBlob& blob : blobs_)
            list.push_back({blob.center, blob.radius, blob.crossSection, {}});
        return BlobMedium(list);
    }();
    double largest = 0.0;
    for (const MediumBlob& blob : blobs_)
        largest = std::max(largest, independent.extinctionAt(blob.center));
    PathSampler sampler(3, 0, 0);
    for (int i = 0; i < 20000; ++i)
        largest = std::max(
            largest, independent.extinctionAt({3.0 * sampler.number() - 1.5, 3.0 * sampler.number() - 1.5,
                                               3.0 * sampler.number() - 1.5}));
    EXPECT_LE(largest, majorant);
    EXPECT_LT(majorant, 1.6 * largest);
}

TEST_F(PathDepth, forcedCollisionsShareTheLightWithWhatPasses)
{
    MediumTracker tracker(medium_.get(), FlightEstimator::Depth, ShadowEstimator::Exact);
    const TraceRay ray = someRay(4);
    FlightStart start{ray};
    Statistics nearer;
    for (uint32_t i = 0; i < 20000; ++i) {
        PathSampler sampler(8, 0, i);
        glm::dvec3 throughput(1.0), luminance(0.0);
        start.isForced = true;
        const Flight forced = tracker.fly(start, sampler, throughput, luminance);
        ASSERT_TRUE(forced.isScattered);
        const double depth = tracker.lastWay()->depth();
        ASSERT_NEAR(forced.colliding, 1.0 - std::exp(-depth), 1e-15);
        ASSERT_NEAR(forced.passing, std::exp(-depth), 1e-15);
        nearer.add(tracker.lastWay()->depthTo(forced.distance) < 0.3 * depth);
        if (i == 0) {
            ASSERT_GT(depth, 0.3);
        }
    }
    const double depth = tracker.lastWay()->depth();
    EXPECT_NEAR(nearer.mean(), -std::expm1(-0.3 * depth) / -std::expm1(-depth), 3.0 * nearer.error());
}

/// As bright as a cosine above, dark below.
struct SomeSky final : PathSky
{
    glm::dvec3 luminance(const glm::dvec3& direction) const override
    {
        return glm::dvec3(0.2, 0.4, 0.8) * std::max(0.0, direction.y);
    }
};

TEST_F(PathDepth, noEstimatorChangesTheLightOfAPath)
{
    const SomeSky sky;
    const SunLight sun(glm::normalize(glm::dvec3(0.3, 0.9, 0.2)), glm::dvec3(3.0, 2.5, 2.0), 0.005);
    const std::array<const PathLight*, 1> lights{&sun};
    PathScene scene;
    scene.medium = medium_.get();
    scene.lights = lights;
    scene.sky = &sky;
    const std::array<PathSettings, 5> all{{
        {.flight = FlightEstimator::Analog, .shadow = ShadowEstimator::Delta},
        {.flight = FlightEstimator::LocalMajorants, .shadow = ShadowEstimator::Ratio},
        {.forcedFlights = 0},
        {.forcedFlights = 1},
        {.forcedFlights = 3, .roulette = 0.5},
    }};
    for (const uint32_t number : {4u, 9u}) {
        std::vector<std::array<Statistics, 3>> found(all.size());
        for (size_t k = 0; k < all.size(); ++k) {
            PathIntegrator integrator(scene, all[k]);
            for (uint32_t i = 0; i < (k == 0 ? 8000u : 4000u); ++i) {
                PathSampler sampler(31 + k, 0, i);
                const PathResult path = integrator.trace(someRay(number), 0.0, sampler);
                for (int channel = 0; channel < 3; ++channel)
                    found[k][size_t(channel)].add(path.luminance[channel] + 0.1 * path.throughput[channel]);
            }
        }
        for (size_t k = 0; k < all.size(); ++k)
            for (size_t channel = 0; channel < 3; ++channel) {
                const double error = std::hypot(found[k][channel].error(), found[3][channel].error());
                EXPECT_NEAR(found[k][channel].mean(), found[3][channel].mean(), 3.0 * error)
                    << k << ' ' << channel;
            }
        EXPECT_LT(found[3][0].variance(), found[1][0].variance());
        EXPECT_LT(found[1][0].variance(), found[0][0].variance());
    }
}

TEST_F(PathDepth, emittedLightOnTheWayIsTheIntegral)
{
    PathScene scene;
    scene.medium = medium_.get();
    const auto way = medium_->depthWalk();
    for (const size_t hot : {0, 14, 35}) {
        const glm::dvec3 from(3.0, 0.4, 0.2);
        const TraceRay ray{from, glm::normalize(blobs_[hot].center - from)};
        way->start(ray, 0.0, 1e30);
        const auto [begin, end] = way->extent();
        constexpr int kSteps = 20000;
        double expected = 0.0;
        for (int i = 0; i < kSteps; ++i) {
            const double t = begin + (i + 0.5) / kSteps * (end - begin);
            expected += way->at(t, 0.0).emission.x * std::exp(-way->depthTo(t)) * (end - begin) / kSteps;
        }
        ASSERT_GT(expected, 0.01);
        std::array<Statistics, 2> found;
        for (const FlightEstimator flight : {FlightEstimator::Depth, FlightEstimator::LocalMajorants}) {
            PathIntegrator integrator(scene, {.bounces = 0, .flight = flight});
            for (uint32_t i = 0; i < 4000; ++i) {
                PathSampler sampler(5, 0, i);
                found[size_t(flight)].add(integrator.trace(ray, 0.0, sampler).luminance.x);
            }
            EXPECT_NEAR(found[size_t(flight)].mean(), expected, 3.0 * found[size_t(flight)].error()) << hot;
        }
        EXPECT_LT(5.0 * found[0].variance(), found[1].variance());
    }
}

TEST_F(PathDepth, directionsOfEmittedLightHaveTheirDensity)
{
    ASSERT_TRUE(medium_->shines());
    const auto way = medium_->depthWalk();
    for (const glm::dvec3& place :
         {glm::dvec3(0.0, 2.5, 0.4), blobs_[7].center + 0.01, glm::dvec3(0.1, 0.0, -0.2)})
    {
        Statistics all, upwards, expected;
        const glm::dvec3 axis = glm::normalize(glm::dvec3(0.3, -1.0, 0.5));
        for (uint32_t i = 0; i < 40000; ++i) {
            PathSampler sampler(6, 0, i);
            const auto [u, v] = sampler.pair();
            const glm::dvec3 direction = PhaseFunction::around({0, 1, 0}, 1.0 - 2.0 * u, v);
            way->start({place, direction}, 0.0, 1e30);
            const double anywhere = way->emissionDensity();
            all.add(4.0 * kPi * anywhere);
            expected.add(glm::dot(direction, axis) > 0.95 ? 4.0 * kPi * anywhere : 0.0);
            const auto [a, b] = sampler.pair();
            const glm::dvec3 drawn = medium_->emissionDirection(place, {sampler.number(), a, b});
            upwards.add(glm::dot(drawn, axis) > 0.95);
            way->start({place, drawn}, 0.0, 1e30);
            const double density = way->emissionDensity();
            EXPECT_GT(density, 0.0);
            way->start({place, drawn}, 0.0,
                       0.2); // a wall changes what is seen in a direction, not its density
            EXPECT_NEAR(way->emissionDensity(), density, 1e-12 * density);
        }
        EXPECT_NEAR(all.mean(), 1.0, 3.0 * all.error());
        EXPECT_NEAR(upwards.mean(), expected.mean(), 3.0 * std::hypot(upwards.error(), expected.error()));
    }
}

TEST_F(PathDepth, glowIsLookedForLessOftenBesideBrighterLights)
{
    const glm::dvec3 place(0.0, 3.0, 0.0), farAway(0.0, 300.0, 0.0);
    EXPECT_EQ(medium_->emissionChance(place), 1.0);
    const BlobPathMedium beside(blobs_, glm::dvec3(0.0), *tasks_, 3.0);
    EXPECT_LT(beside.emissionChance(place), 1.0);
    EXPECT_LT(beside.emissionChance(farAway), beside.emissionChance(place));
    EXPECT_GT(beside.emissionChance(farAway), 0.0);
    EXPECT_EQ(BlobPathMedium(blobs_, glm::dvec3(0.0), *tasks_, 1e6).emissionChance(place), 0.0);
}

TEST_F(PathDepth, hotGasLightsAFloorWithLessNoiseAndTheSameLight)
{
    const std::vector<glm::vec3> positions{{-9, -0.3f, -9}, {-9, -0.3f, 9}, {9, -0.3f, -9},
                                           {9, -0.3f, -9},  {-9, -0.3f, 9}, {9, -0.3f, 9}};
    const std::vector<glm::vec3> normals(6, {0, 1, 0}), colors(6, glm::vec3(0.5f));
    TriangleScene triangles;
    PathScene scene;
    scene.medium = medium_.get();
    scene.mesh = {glm::dvec3(0.0), positions, normals, colors};
    triangles.build(scene.mesh, glm::dvec3(0.0), *tasks_);
    scene.triangles = &triangles;
    const TraceRay ray{{3, 1, 0}, glm::normalize(glm::dvec3(-1.4, -1.3, 0.1))}; // half of the gas is below
    const BlobPathMedium sometimes(blobs_, glm::dvec3(0.0), *tasks_,
                                   5.0); // looks for glow with a chance below 1
    const BlobPathMedium never(blobs_, glm::dvec3(0.0), *tasks_, 1e6);
    std::array<Statistics, 4> found;
    for (size_t k = 0; k < found.size(); ++k) {
        scene.medium = k == 2 ? &sometimes : k == 3 ? &never : medium_.get();
        PathIntegrator integrator(
            scene, {.flight = k == 1 ? FlightEstimator::LocalMajorants : FlightEstimator::Depth});
        for (uint32_t i = 0; i < (k == 1 ? 40000u : 20000u); ++i) {
            PathSampler sampler(5 + k, 0, i);
            found[k].add(integrator.trace(ray, 0.0, sampler).luminance.x);
        }
        EXPECT_NEAR(found[k].mean(), found[0].mean(), 3.0 * std::hypot(found[k].error(), found[0].error()));
    }
    EXPECT_LT(3.0 * found[0].variance(), found[1].variance());
    EXPECT_LT(found[2].variance(), found[3].variance());
}

TEST(HomogeneousDepth, isThatOfTheShape)
{
    const MediumPoint point = substance(2.0, 0.5);
    const auto way = HomogeneousMedium({MediumShape::Kind::Ball, {}, {0.5, 0, 0}}, point).depthWalk();
    ASSERT_TRUE(way);
    way->start({{-5, 0.3, 0}, {1, 0, 0}}, 0.0, 5.1);
    EXPECT_NEAR(way->depth(), 2.0 * 0.5, 1e-12); // 0.4 m before the middle, 0.1 m behind it
    EXPECT_NEAR(way->parameterAt(0.4), 4.8, 1e-12);
    way->start({{-5, 0.6, 0}, {1, 0, 0}}, 0.0, 5.1);
    EXPECT_EQ(way->depth(), 0.0);
    MediumPoint colored = point;
    colored.extinction = {2.0, 1.0, 2.0};
    EXPECT_FALSE(HomogeneousMedium({}, colored).depthWalk());
    EXPECT_FALSE(HomogeneousMedium({}, point, false).depthWalk());
}

} // namespace
} // namespace fx::render
