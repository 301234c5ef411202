/// The mean distance of what a ray sees.

#include "rendering/reference/render/seen_depth.h"

#include "rendering/reference/blob_medium/blob_medium.h"
#include "rendering/reference/trace/ray_query.h"
#include "tests/rendering/reference/trace/ball_scenes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace fx::render {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();

MediumDepth depthOf(const std::vector<MediumBlob>& blobs, double begin, double end)
{
    MediumView medium;
    medium.build(blobs, glm::dvec3(0.0), *base::makeSerialRunner());
    RayHits hits;
    findHits(medium.tree(), {glm::dvec3(0.0), {0.0, 0.0, -1.0}}, begin, end, hits);
    SeenDepth depth;
    return depth.along(medium, hits, begin, end);
}

MediumBlob blobAt(double distance, double radius, double crossSection)
{
    MediumBlob blob;
    blob.center = {0.0, 0.0, -distance};
    blob.radius = radius;
    blob.crossSection = crossSection;
    return blob;
}

TEST(SeenDepth, aThinBlobIsSeenAtItsMiddle)
{
    EXPECT_NEAR(depthOf({blobAt(10.0, 2.0, 1e-6)}, 0.0, kInf).distance, 10.0, 1e-3);
}

TEST(SeenDepth, anOpaqueBlobIsSeenNearItsFront)
{
    const double distance = depthOf({blobAt(10.0, 2.0, 1e7)}, 0.0, kInf).distance;
    EXPECT_GE(distance, 8.0);
    EXPECT_LE(distance, 8.0 + 4.0 / 64.0);
}

TEST(SeenDepth, twoThinBlobsAreSeenAtTheMeanOfTheirPlaces)
{
    EXPECT_NEAR(depthOf({blobAt(5.0, 1.0, 1e-6), blobAt(20.0, 1.0, 3e-6)}, 0.0, kInf).distance, 16.25, 2e-2);
}

TEST(SeenDepth, aSurfaceCutsWhatIsSeen)
{
    const MediumDepth cut = depthOf({blobAt(10.0, 2.0, 1.0)}, 0.0, 10.0);
    const MediumDepth whole = depthOf({blobAt(10.0, 2.0, 1.0)}, 0.0, kInf);
    EXPECT_LT(cut.distance, 10.0);
    EXPECT_NEAR(cut.opticalDepth, 0.5 * whole.opticalDepth, 1e-12);
}

TEST(SeenDepth, noMediumIsInfinitelyFar)
{
    EXPECT_EQ(depthOf({}, 0.0, kInf).distance, kInf);
    EXPECT_EQ(depthOf({blobAt(-10.0, 2.0, 1.0)}, 0.0, kInf).opticalDepth, 0.0);
}

TEST(SeenDepth, staysWithinItsBoundOfAFineSum)
{
    test::Chance chance(5);
    for (int scene = 0; scene < 20; ++scene) {
        std::vector<MediumBlob> blobs;
        std::vector<Blob> same;
        for (int i = 0; i < 10; ++i) {
            blobs.push_back(
                blobAt(chance.between(3.0, 9.0), chance.between(0.5, 2.0), chance.between(0.1, 6.0)));
            same.push_back({blobs.back().center, blobs.back().radius, blobs.back().crossSection, {}});
        }
        const BlobMedium medium(same);
        const Ray ray{glm::dvec3(0.0), {0.0, 0.0, -1.0}};
        double moment = 0.0;
        double before = 0.0;
        for (int k = 0; k < 4000; ++k) {
            const double t = 11.5 * (k + 1) / 4000.0;
            const double opacity = -std::expm1(-medium.opticalDepth(ray, 0.0, t));
            moment += (opacity - before) * (t - 11.5 / 8000.0);
            before = opacity;
        }
        const MediumDepth depth = depthOf(blobs, 0.0, kInf);
        EXPECT_NEAR(depth.distance, moment / before, 10.0 / 128.0);
        EXPECT_NEAR(depth.opticalDepth, medium.opticalDepth(ray, 0.0, 100.0), 1e-12 * depth.opticalDepth);
    }
}

} // namespace
} // namespace fx::render
