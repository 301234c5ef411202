// Paths through fields with detail, against the integral along rays.
#include "rendering/optics/black_body.h"
#include "rendering/reference/render/detailed_ray.h"
#include "rendering/reference/trace/ray_query.h"
#include "tests/rendering/reference/path/path_statistics.h"
#include "tests/rendering/reference/path/path_test_media.h"
#include "tests/rendering/reference/render/detail_scenes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace fx::render {
namespace {

constexpr uint32_t kPaths = 20000;
const TraceRay kRay{{-3, 0.1, 0.05}, {1, 0, 0}};

/// Blobs with detail for both renderers.
class PathDetail : public testing::Test
{
protected:
    void make(const FieldDetailNumbers& numbers, const glm::dvec3& albedo, float temperature = 0.0f)
    {
        blobs_ = someBlobs(60, 0.25, albedo);
        details_ = test::detailsOf(blobs_, numbers, temperature);
    }
    BlobPathMedium medium() const { return {blobs_, glm::dvec3(0.0), *tasks_, 0.0, details_, {}}; }
    /// Of a ray, by quadrature.
    DetailedRay& integral()
    {
        view_.build(blobs_, glm::dvec3(0.0), *tasks_, details_, {});
        detailed_.emplace(view_, DetailedRay::Wanted::Light, 1e-4);
        findHits(view_.tree(), kRay, 0.0, 1e30, hits_);
        detailed_->trace(kRay, hits_, 0.0, 1e30);
        return *detailed_;
    }

    std::unique_ptr<base::TaskRunner> tasks_ = base::makeSerialRunner();
    std::vector<MediumBlob> blobs_;
    MediumDetails details_;
    MediumView view_;
    RayHits hits_;
    std::optional<DetailedRay> detailed_;
};

TEST_F(PathDetail, passesTheTransmittanceOfTheIntegral)
{
    make(test::someDetail(), glm::dvec3(0.0));
    const double passing = std::exp(-integral().opticalDepth());
    ASSERT_GT(passing, 0.05);
    ASSERT_LT(passing, 0.8);
    const BlobPathMedium medium = this->medium();
    for (const FlightEstimator flight :
         {FlightEstimator::Depth, FlightEstimator::LocalMajorants, FlightEstimator::Analog})
    {
        MediumTracker tracker(&medium, flight, ShadowEstimator::Exact);
        Statistics result, shadow;
        for (uint32_t i = 0; i < (flight == FlightEstimator::Analog ? kPaths / 10 : kPaths); ++i) {
            PathSampler sampler(1, 0, i);
            glm::dvec3 throughput(1.0), luminance(0.0);
            tracker.fly({kRay}, sampler, throughput, luminance);
            result.add(throughput.x);
            shadow.add(tracker.transmittance(kRay, 0.0, 1e30, sampler).x);
        }
        EXPECT_NEAR(result.mean(), passing, 3.5 * result.error()) << int(flight);
        EXPECT_NEAR(shadow.mean(), passing, 3.5 * shadow.error()) << int(flight);
    }
}

TEST_F(PathDetail, extinctionsStayBelowTheirMajorants)
{
    make(test::someDetail(), glm::dvec3(0.0));
    const BlobPathMedium medium = this->medium();
    const double all = medium.majorant();
    const auto walk = medium.walk();
    double closest = 0.0;
    for (int i = 0; i < 40; ++i) {
        walk->start({{-3, 0.02 * i - 0.4, 0.3}, {1, 0, 0}}, 0.0, 1e30);
        MajorantSegment segment;
        while (walk->next(segment))
            for (int k = 0; k <= 50; ++k) {
                const double t = segment.begin + (segment.end - segment.begin) * k / 50.0;
                const double extinction = walk->at(t, 0.0).extinction.x;
                ASSERT_LE(extinction, segment.majorant);
                ASSERT_LE(extinction, all);
                closest = std::max(closest, extinction / segment.majorant);
            }
    }
    EXPECT_GT(closest, 0.9);
}

TEST_F(PathDetail, hotBumpsEmitTheLightOfTheIntegral)
{
    FieldDetailNumbers numbers = test::someDetail();
    numbers.cooling = 0.16f;
    numbers.glow = 0.09f;
    make(numbers, glm::dvec3(0.0), 1400.0f);
    for (MediumBlob& blob : blobs_)
        blob.source = glm::dvec3(blackBodyLuminance(1400.0f)) + glm::dvec3(500.0); // not all of it is thermal
    const glm::dvec3 light = integral().light();
    const BlobPathMedium medium = this->medium();
    MediumTracker tracker(&medium, FlightEstimator::Depth, ShadowEstimator::Exact);
    std::array<Statistics, 3> result;
    for (uint32_t i = 0; i < 4 * kPaths; ++i) {
        PathSampler sampler(2, 0, i);
        glm::dvec3 throughput(1.0), luminance(0.0);
        tracker.fly({kRay}, sampler, throughput, luminance);
        for (int c = 0; c < 3; ++c)
            result[size_t(c)].add(luminance[c]);
    }
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(result[size_t(c)].mean(), light[c], 3.5 * result[size_t(c)].error()) << c;
}

TEST_F(PathDetail, lightThatIsSentIsAbsorbedOrEscapes)
{
    make(test::someDetail(), glm::dvec3(0.9), 1400.0f);
    for (MediumBlob& blob : blobs_)
        blob.source = glm::dvec3(1.0) - blob.albedo;
    const BlobPathMedium medium = this->medium();
    MediumTracker tracker(&medium, FlightEstimator::Depth, ShadowEstimator::Exact);
    uint32_t scattered = 0;
    for (uint32_t i = 0; i < 1000; ++i) {
        PathSampler sampler(5, 0, i);
        const Escape out = escape(tracker, kRay, sampler);
        ASSERT_TRUE(out.isOut);
        scattered += out.scatterings > 0;
        EXPECT_NEAR(out.throughput.x + out.luminance.x, 1.0, 1e-12);
    }
    EXPECT_GT(scattered, 300u);
}

} // namespace
} // namespace fx::render
