#include "tests/rendering/reference/path/path_statistics.h"
#include "tests/rendering/reference/path/path_test_media.h"

#include "rendering/reference/blob_medium/blob_medium.h"

#include <glm/geometric.hpp>

#include <gtest/gtest.h>

#include <algorithm>

namespace fx::render {
namespace {

TraceRay rayThroughTheMiddle(uint32_t number)
{
    PathSampler sampler(31, number, 0);
    const double cosine = 1.0 - 2.0 * sampler.number();
    const glm::dvec3 direction = PhaseFunction::around({0, 1, 0}, cosine, sampler.number());
    const glm::dvec3 aside = PhaseFunction::around(direction, 0.0, sampler.number());
    return {-3.0 * direction + aside * (1.4 * sampler.number()), direction};
}

BlobMedium independent(const std::vector<MediumBlob>& blobs)
{
    std::vector<Blob> list;
    for (const MediumBlob& blob : blobs)
        list.push_back({blob.center, blob.radius, blob.crossSection, blob.source});
    return BlobMedium(list);
}

class BlobPath : public ::testing::Test
{
protected:
    std::unique_ptr<base::TaskRunner> tasks_ = base::makeSerialRunner();
    std::vector<MediumBlob> blobs_ = someBlobs(60, 0.4, glm::dvec3(0.8));
    BlobPathMedium medium_{blobs_, glm::dvec3(0.0), *tasks_};
    BlobMedium independent_ = independent(blobs_);
};

TEST_F(BlobPath, segmentsBoundTheExtinctionAndLeaveNothingOut)
{
    const auto walk = medium_.walk();
    for (uint32_t number = 0; number < 200; ++number) {
        const TraceRay ray = rayThroughTheMiddle(number);
        PathSampler sampler(8, number, 0);
        std::vector<MajorantSegment> segments;
        walk->start(ray, 0.5, 5.0);
        double last = 0.5;
        for (MajorantSegment segment; walk->next(segment);) {
            ASSERT_LE(last, segment.begin);
            ASSERT_LT(segment.begin, segment.end);
            last = segment.end;
            for (int i = 0; i < 8; ++i) {
                const double t = segment.begin + (segment.end - segment.begin) * sampler.number();
                const double extinction = walk->at(t, 0.5).extinction.x;
                const double expected = independent_.extinctionAt(ray.origin + t * ray.direction);
                ASSERT_NEAR(extinction, expected, 1e-9 * (1.0 + expected));
                ASSERT_LE(expected, segment.majorant * (1.0 + 1e-9));
            }
            segments.push_back(segment);
        }
        ASSERT_LE(last, 5.0);
        for (int i = 0; i < 50; ++i) {
            const double t = 0.5 + 4.5 * sampler.number();
            const bool isInside =
                std::any_of(segments.begin(), segments.end(),
                            [&](const MajorantSegment& s) { return s.begin <= t && t <= s.end; });
            if (!isInside) {
                ASSERT_LT(independent_.extinctionAt(ray.origin + t * ray.direction), 1e-12);
            }
        }
    }
}

TEST_F(BlobPath, knowsItsOpticalDepth)
{
    const auto walk = medium_.walk();
    for (uint32_t number = 0; number < 200; ++number) {
        const TraceRay ray = rayThroughTheMiddle(number);
        glm::dvec3 depth;
        ASSERT_TRUE(walk->opticalDepth(ray, 1.1, 3.7, depth));
        const double expected = independent_.opticalDepth({ray.origin, ray.direction}, 1.1, 3.7);
        EXPECT_NEAR(depth.x, expected, 1e-9 * (1.0 + expected));
    }
}

TEST_F(BlobPath, mixedSubstancesScatterTheirSum)
{
    blobs_[0].anisotropy = 0.6;
    for (size_t i = 0; i < blobs_.size(); ++i)
        blobs_[i].albedo = {0.1 + 0.014 * double(i), 0.5, 0.9 - 0.01 * double(i)};
    const BlobPathMedium medium(blobs_, glm::dvec3(0.0), *tasks_);
    const auto walk = medium.walk();
    constexpr double t = 3.0; // in the middle of the ball whose phase function is another one
    const glm::dvec3 direction = rayThroughTheMiddle(1).direction;
    const TraceRay ray{blobs_[0].center - t * direction, direction};
    walk->start(ray, 0.0, 6.0);
    MajorantSegment segment{};
    while (segment.end < t)
        ASSERT_TRUE(walk->next(segment));
    ASSERT_LE(segment.begin, t);
    glm::dvec3 expected(0.0);
    int balls = 0;
    for (const MediumBlob& blob : blobs_) {
        const double extinction = BlobMedium({{blob.center, blob.radius, blob.crossSection, {}}})
                                      .extinctionAt(ray.origin + t * ray.direction);
        balls += extinction > 0.0 ? 1 : 0;
        expected += blob.albedo * extinction;
    }
    ASSERT_GE(balls, 3);
    constexpr int kChoices = 20000;
    glm::dvec3 mean(0.0);
    for (int i = 0; i < kChoices; ++i)
        mean += walk->at(t, (i + 0.5) / kChoices).scattering / double(kChoices);
    for (int channel = 0; channel < 3; ++channel)
        EXPECT_NEAR(mean[channel] / expected[channel], 1.0, 1e-3);
}

TEST_F(BlobPath, standsWhereTheWorldIsFarAway)
{
    const glm::dvec3 far(1e6, -2e6, 5e5);
    std::vector<MediumBlob> moved = blobs_;
    for (MediumBlob& blob : moved)
        blob.center += far;
    const BlobPathMedium medium(moved, far, *tasks_);
    const auto walk = medium.walk();
    const TraceRay ray = rayThroughTheMiddle(3);
    glm::dvec3 depth;
    walk->opticalDepth(ray, 0.0, 6.0, depth);
    const double expected = independent_.opticalDepth({ray.origin, ray.direction}, 0.0, 6.0);
    EXPECT_NEAR(depth.x / expected, 1.0, 1e-6);
}

TEST(HomogeneousMedium, cutsRaysAtItsShape)
{
    const MediumPoint point = substance(2.0, 0.5);
    const TraceRay across{{-5, 0.25, 0}, {1, 0, 0}};
    const auto depth = [&](const MediumShape& shape, const TraceRay& ray) {
        glm::dvec3 out;
        HomogeneousMedium(shape, point).walk()->opticalDepth(ray, 0.0, 1e30, out);
        return out.x;
    };
    EXPECT_NEAR(depth({MediumShape::Kind::Ball, {}, {0.5, 0, 0}}, across), 4.0 * std::sqrt(0.25 - 0.0625),
                1e-12);
    EXPECT_NEAR(depth({MediumShape::Kind::Box, {}, {0.5, 1.0, 2.0}}, across), 2.0, 1e-12);
    EXPECT_EQ(depth({MediumShape::Kind::Box, {}, {0.5, 0.2, 2.0}}, across), 0.0);
    const glm::dvec3 slanted = glm::normalize(glm::dvec3(0, -1, 2));
    EXPECT_NEAR(depth({MediumShape::Kind::Slab, {}, {0, 0.5, 0}}, {{0, 9, 0}, slanted}), 2.0 * std::sqrt(5.0),
                1e-12);
}

} // namespace
} // namespace fx::render
