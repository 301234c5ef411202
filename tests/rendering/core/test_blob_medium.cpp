#include "rendering/reference/blob_medium/blob_medium.h"

#include <gtest/gtest.h>

#include <cmath>

using fx::render::BlobMedium;
using fx::render::marchEmission;
using fx::render::Ray;

namespace {

const Ray kRay{{0.0, 0.0, 5.0}, {0.0, 0.0, -1.0}};

BlobMedium twoBlobs()
{
    return BlobMedium(
        {{{0.2, 0.0, 0.0}, 1.0, 2.0, {3.0, 3.0, 3.0}}, {{-0.3, 0.1, -0.8}, 0.7, 1.5, {3.0, 3.0, 3.0}}});
}

} // namespace

TEST(BlobMedium, opticalDepthIsTheIntegralOfExtinction)
{
    const BlobMedium medium = twoBlobs();
    double sum = 0.0;
    const int steps = 20000;
    for (int i = 0; i < steps; ++i)
        sum += medium.extinctionAt(kRay.origin + kRay.direction * (10.0 * (i + 0.5) / steps)) * 10.0 / steps;
    EXPECT_NEAR(medium.opticalDepth(kRay, 0.0, 10.0), sum, 1e-6);
}

TEST(BlobMedium, nothingLiesOutsideItsSpan)
{
    const BlobMedium medium = twoBlobs();
    const auto span = medium.span(kRay);
    EXPECT_EQ(medium.opticalDepth(kRay, 0.0, span.begin), 0.0);
    EXPECT_EQ(medium.opticalDepth(kRay, span.end, 100.0), 0.0);
    EXPECT_GT(medium.opticalDepth(kRay, span.begin, span.end), 0.0);
}

TEST(BlobMedium, aRayThatMissesHasAnEmptySpan)
{
    const auto span = twoBlobs().span({{9.0, 0.0, 5.0}, {0.0, 0.0, -1.0}});
    EXPECT_LE(span.end, span.begin);
}

TEST(MarchEmission, ofAFurnaceIsItsSourceTimesOpacity)
{
    const BlobMedium medium = twoBlobs();
    const double opacity = 1.0 - std::exp(-medium.opticalDepth(kRay, 0.0, 10.0));
    EXPECT_NEAR(marchEmission(medium, kRay, 0.0, 10.0, 400).x, 3.0 * opacity, 1e-9);
}

TEST(MarchEmission, convergesWithTheSquareOfTheStep)
{
    const BlobMedium medium(
        {{{0.0, 0.0, 0.0}, 1.0, 2.0, {5.0, 0.0, 0.0}}, {{0.0, 0.0, -0.6}, 1.0, 2.0, {1.0, 0.0, 0.0}}});
    const double exact = marchEmission(medium, kRay, 0.0, 10.0, 20000).x;
    const double coarse = std::abs(marchEmission(medium, kRay, 0.0, 10.0, 50).x - exact);
    const double fine = std::abs(marchEmission(medium, kRay, 0.0, 10.0, 100).x - exact);
    EXPECT_NEAR(coarse / fine, 4.0, 0.6);
}
