#include "tests/rendering/reference/path/path_statistics.h"
#include "tests/rendering/reference/path/path_test_media.h"

#include <glm/geometric.hpp>

#include <gtest/gtest.h>

#include <array>

namespace fx::render {
namespace {

constexpr uint32_t kPaths = 40000;

MediumTracker trackerOf(const PathMedium& medium, FlightEstimator flight = FlightEstimator::LocalMajorants,
                        ShadowEstimator shadow = ShadowEstimator::Exact)
{
    return MediumTracker(&medium, flight, shadow);
}

/// Light that passes without a collision, by channel: black media, so that scattering never happens.
std::array<Statistics, 3> passing(MediumTracker& tracker, const TraceRay& ray)
{
    std::array<Statistics, 3> result;
    for (uint32_t i = 0; i < kPaths; ++i) {
        PathSampler sampler(1, 0, i);
        glm::dvec3 throughput(1.0), luminance(0.0);
        tracker.fly({ray}, sampler, throughput, luminance);
        for (int channel = 0; channel < 3; ++channel)
            result[size_t(channel)].add(throughput[channel]);
    }
    return result;
}

TEST(PathFlight, passesTheTransmittanceOfAHomogeneousBoxInEveryChannel)
{
    for (const double depth : {0.05, 1.0, 4.0})
        for (const double looseness : {1.0, 3.0}) {
            MediumPoint point;
            point.extinction = depth * glm::dvec3(1.0, 0.6, 0.25);
            const HomogeneousMedium medium({MediumShape::Kind::Box, {}, {0.5, 0.5, 0.5}}, point, true,
                                           looseness);
            MediumTracker tracker = trackerOf(medium);
            const auto result = passing(tracker, {{-3, 0, 0}, {1, 0, 0}});
            for (int channel = 0; channel < 3; ++channel)
                EXPECT_NEAR(result[size_t(channel)].mean(), std::exp(-point.extinction[channel]),
                            3.0 * result[size_t(channel)].error() + 1e-12)
                    << depth << ' ' << looseness << ' ' << channel;
        }
}

TEST(PathFlight, passesTheTransmittanceOfBlobsWithBothMajorants)
{
    const auto tasks = base::makeSerialRunner();
    const std::vector<MediumBlob> blobs = someBlobs(60, 0.15, glm::dvec3(0.0));
    const BlobPathMedium medium(blobs, glm::dvec3(0.0), *tasks);
    const TraceRay ray{{-3, 0.2, 0.1}, {1, 0, 0}};
    glm::dvec3 depth;
    medium.walk()->opticalDepth(ray, 0.0, 1e30, depth);
    ASSERT_GT(depth.x, 0.3);
    ASSERT_LT(depth.x, 3.0);
    const auto collisions = [&](FlightEstimator flight) {
        MediumTracker tracker = trackerOf(medium, flight);
        const Statistics result = passing(tracker, ray)[0];
        EXPECT_NEAR(result.mean(), std::exp(-depth.x), 3.0 * result.error());
        return tracker.collisions();
    };
    const uint64_t local = collisions(FlightEstimator::LocalMajorants);
    EXPECT_GT(local, 0u);
    EXPECT_LT(local, collisions(FlightEstimator::Analog)); // tighter majorants, fewer null collisions
}

TEST(PathFlight, scattersAtDistancesOfTheExponentialLaw)
{
    const HomogeneousMedium medium({MediumShape::Kind::Slab, {}, {0, 50.0, 0}}, substance(1.5, 1.0), true,
                                   2.5);
    MediumTracker tracker = trackerOf(medium);
    Statistics distance;
    for (uint32_t i = 0; i < kPaths; ++i) {
        PathSampler sampler(1, 0, i);
        glm::dvec3 throughput(1.0), luminance(0.0);
        const Flight flight = tracker.fly({{{0, 0, 0}, {1, 0, 0}}}, sampler, throughput, luminance);
        ASSERT_TRUE(flight.isScattered);
        EXPECT_NEAR(throughput.x, 1.0, 1e-12);
        distance.add(flight.distance);
    }
    EXPECT_NEAR(distance.mean(), 1.0 / 1.5, 3.0 * distance.error());
    EXPECT_NEAR(distance.variance() * 1.5 * 1.5, 1.0, 0.05);
}

TEST(PathFlight, shadowEstimatorsAgreeWithTheIntegral)
{
    const auto tasks = base::makeSerialRunner();
    const BlobPathMedium medium(someBlobs(60, 0.15, glm::dvec3(0.5)), glm::dvec3(0.0), *tasks);
    const TraceRay ray{{-3, -0.1, 0.2}, {1, 0, 0}};
    glm::dvec3 depth;
    medium.walk()->opticalDepth(ray, 0.4, 3.3, depth);
    std::array<double, 3> variance{};
    for (const ShadowEstimator shadow :
         {ShadowEstimator::Exact, ShadowEstimator::Ratio, ShadowEstimator::Delta}) {
        MediumTracker tracker = trackerOf(medium, FlightEstimator::LocalMajorants, shadow);
        Statistics result;
        for (uint32_t i = 0; i < kPaths; ++i) {
            PathSampler sampler(6, 0, i);
            result.add(tracker.transmittance(ray, 0.4, 3.3, sampler).x);
        }
        EXPECT_NEAR(result.mean(), std::exp(-depth.x), 3.0 * result.error() + 1e-12);
        variance[size_t(shadow)] = result.variance();
    }
    EXPECT_LT(variance[0], 1e-20);
    EXPECT_LT(variance[1], variance[2]);
}

TEST(PathFlight, lightThatIsSentIsAbsorbedOrEscapes)
{
    // The medium emits what it absorbs, so the light that fly() gathers is what each path loses.
    const auto tasks = base::makeSerialRunner();
    std::vector<MediumBlob> blobs = someBlobs(60, 0.6, glm::dvec3(0.9), 0.5);
    for (MediumBlob& blob : blobs)
        blob.source = glm::dvec3(1.0) - blob.albedo;
    const BlobPathMedium medium(blobs, glm::dvec3(0.0), *tasks);
    MediumTracker tracker = trackerOf(medium);
    uint32_t scattered = 0;
    for (uint32_t i = 0; i < 2000; ++i) {
        PathSampler sampler(5, 0, i);
        const Escape out = escape(tracker, {{-3, 0.3, 0}, {1, 0, 0}}, sampler);
        ASSERT_TRUE(out.isOut);
        scattered += out.scatterings > 0;
        EXPECT_NEAR(out.throughput.x + out.luminance.x, 1.0, 1e-12);
    }
    EXPECT_GT(scattered, 1000u);
}

} // namespace
} // namespace fx::render
