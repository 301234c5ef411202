/// The picture as a whole: against an independent march through the medium, and against itself moved, cut
/// into tiles, resumed.

#include "rendering/reference/render/reference_renderer.h"

#include "rendering/reference/blob_medium/blob_medium.h"
#include "tests/foundation/every_set.h"
#include "tests/rendering/reference/render/reference_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace fx::render {
namespace {

namespace channel = reference_channel;

BlobMedium mediumOf(const ReferenceScene& scene)
{
    std::vector<Blob> blobs;
    for (const MediumBlob& blob : scene.blobs)
        blobs.push_back({blob.center, blob.radius, blob.crossSection, blob.source});
    return BlobMedium(blobs);
}

Ray worldRay(const ReferenceScene& scene, const ReferenceSettings& settings, int x, int y)
{
    const TraceRay ray = scene.camera.grid(settings.width, settings.height).ray(x + 0.5, y + 0.5);
    return {scene.camera.eye + ray.origin, ray.direction};
}

TEST(ReferenceRenderer, everyPixelIsTheIntegralAlongItsOwnRay)
{
    const ReferenceScene scene = test::blobScene(60, 2.0);
    const ReferenceSettings settings = test::smallSettings();
    const test::Rendered picture(scene, settings);
    const BlobMedium medium = mediumOf(scene);
    for (int y = 0; y < settings.height; y += 3)
        for (int x = 0; x < settings.width; x += 5) {
            const Ray ray = worldRay(scene, settings, x, y);
            const size_t i = size_t(y * settings.width + x);
            const double depth = medium.opticalDepth(ray, 0.1, 1e30);
            EXPECT_NEAR(picture[channel::OpticalDepth][i], depth, 1e-6 * (depth + 1.0));
            EXPECT_NEAR(picture[channel::Color + 3][i], 1.0 - std::exp(-depth), 1e-5);
            const glm::dvec3 light = marchEmission(medium, ray, 0.1, 1e30, 2000);
            for (uint32_t c = 0; c < 3; ++c)
                EXPECT_NEAR(picture[channel::Color + c][i], light[int(c)], 1e-4) << x << " " << y;
        }
}

TEST(ReferenceRenderer, coverageOfTheLayersAddsUpToTheOpacity)
{
    const test::Rendered picture(test::blobScene(60, 3.0));
    for (size_t i = 0; i < picture[channel::Color].size(); ++i)
        EXPECT_NEAR(picture[channel::Fire + 3][i] + picture[channel::Smoke + 3][i],
                    picture[channel::Color + 3][i], 1e-3); // what gauss-5 promises
}

TEST(ReferenceRenderer, shiftingSceneAndCameraTogetherDoesNotChangeThePicture)
{
    const ReferenceScene here = test::blobScene(100, 5.0);
    ReferenceScene there = here;
    const glm::dvec3 shift(1e5, -7e4, 1e5);
    for (MediumBlob& blob : there.blobs)
        blob.center += shift;
    there.camera.eye += shift;
    for (const bool isSingle : {false, true}) { // of the integral; everything before it is double
        ReferenceSettings settings = test::smallSettings();
        settings.isSingle = isSingle;
        const test::Rendered a(here, settings);
        const test::Rendered b(there, settings);
        std::vector<double> changes;
        for (size_t i = 0; i < a[0].size(); ++i)
            for (uint32_t c = 0; c < 3; ++c)
                if (a[c][i] > 1e-6f)
                    changes.push_back(std::abs(double(a[c][i]) - double(b[c][i])) / double(a[c][i]));
        std::sort(changes.begin(), changes.end());
        ASSERT_GT(changes.size(), 500u);
        EXPECT_LE(changes[changes.size() / 2], 1e-6);
        EXPECT_LE(changes[changes.size() * 99 / 100], 1e-4);
    }
}

TEST(ReferenceRenderer, parallelRaysCountAllExtinctionOfABlob)
{
    for (const auto& [pixelsPerRadius, samples] :
         {std::pair(0.5, 16), std::pair(1.0, 8), std::pair(4.0, 2), std::pair(15.0, 1), std::pair(100.0, 1)})
    {
        ReferenceScene scene;
        scene.opaque.isEmpty = true;
        MediumBlob blob;
        blob.center = {0.013, -0.021, -5.0};
        blob.radius = 1.0;
        blob.crossSection = 2.5;
        scene.blobs = {blob};
        scene.camera.orthographic = true;
        ReferenceSettings settings;
        settings.width = settings.height = pixelsPerRadius > 10.0 ? 256 : 32;
        settings.samples = samples;
        scene.camera.halfHeight = 0.5 * settings.height / pixelsPerRadius;
        const test::Rendered picture(scene, settings);
        double sum = 0.0;
        for (const float depth : picture[channel::OpticalDepth])
            sum += double(depth);
        EXPECT_NEAR(sum / (pixelsPerRadius * pixelsPerRadius), 2.5, 2.5e-3) << pixelsPerRadius;
    }
}

TEST(ReferenceRenderer, threadsAndInstructionSetsDoNotMatter)
{
    const ReferenceScene scene = test::blobScene(40, 2.0);
    const test::Rendered expected(scene);
    const auto compare = [&](uint32_t threads, const char* what) {
        const test::Rendered picture(scene, test::smallSettings(), threads);
        for (uint32_t c = 0; c < channel::Count; ++c)
            EXPECT_EQ(picture[c], expected[c]) << what << ", channel " << c;
    };
    compare(2, "two threads");
    compare(5, "five threads");
    test::everySet([&](base::InstructionSet) { compare(1, "one thread"); });
}

TEST(ReferenceRenderer, aPixelOfManySamplesIsTheMeanOfItsRays)
{
    const ReferenceScene scene = test::blobScene(30, 1.0);
    ReferenceSettings coarse = test::smallSettings();
    coarse.samples = 3;
    ReferenceSettings fine = coarse;
    fine.samples = 1;
    fine.width *= 3;
    fine.height *= 3;
    const test::Rendered a(scene, coarse);
    const test::Rendered b(scene, fine);
    for (const uint32_t c :
         {uint32_t(channel::Color), uint32_t(channel::OpticalDepth), uint32_t(channel::Smoke + 3)})
        for (int y = 0; y < coarse.height; ++y)
            for (int x = 0; x < coarse.width; ++x) {
                double mean = 0.0;
                for (int k = 0; k < 9; ++k)
                    mean += double(b[c][size_t((3 * y + k / 3) * fine.width + 3 * x + k % 3)]) / 9.0;
                EXPECT_NEAR(a[c][size_t(y * coarse.width + x)], mean, 1e-6);
            }
}

TEST(ReferenceRenderer, nothingGivesAnEmptyTransparentPicture)
{
    ReferenceScene scene = test::blobScene(0, 1.0);
    const test::Rendered picture(scene);
    for (uint32_t c = 0; c < channel::Depth; ++c)
        EXPECT_EQ(*std::max_element(picture[c].begin(), picture[c].end()), 0.0f);
    EXPECT_TRUE(std::isinf(picture[channel::Depth][0]));
}

TEST(ReferenceRenderer, anEyeInsideABlobSeesTheHalfBeforeIt)
{
    ReferenceScene scene;
    scene.opaque.isEmpty = true;
    MediumBlob blob;
    blob.radius = 2.0;
    blob.crossSection = 5.0;
    blob.source = {1.0, 2.0, 3.0};
    scene.blobs = {blob};
    scene.camera.nearDistance = 0.0;
    const test::Rendered picture(scene);
    const size_t middle = size_t(13 * 42 + 21);
    const double half = 0.5 * 3.5 / std::numbers::pi * 5.0 / 4.0;
    EXPECT_NEAR(picture[channel::OpticalDepth][middle], half, 1e-3 * half);
    EXPECT_NEAR(picture[channel::Color][middle], 1.0 - std::exp(-half), 1e-3);
}

TEST(ReferenceRenderer, theLengthOfTheCamerasAxesDoesNotMatter)
{
    ReferenceScene scene = test::blobScene(30, 2.0);
    const test::Rendered expected(scene);
    scene.camera.forward *= 4.0;
    scene.camera.right *= 1e-200;
    scene.camera.up *= 1e200;
    const test::Rendered picture(scene);
    for (uint32_t c = 0; c < 3; ++c)
        for (size_t i = 0; i < expected[c].size(); ++i)
            ASSERT_NEAR(picture[c][i], expected[c][i], 1e-6f);
}

TEST(ReferenceRenderer, refusesBlobsAndSizesOutsideTheirRange)
{
    const auto tasks = base::makeSerialRunner();
    const auto refused = [&](auto change) {
        ReferenceScene scene = test::blobScene(3, 1.0);
        ReferenceSettings settings = test::smallSettings();
        change(scene, settings);
        return ReferenceRenderer().build(scene, settings, *tasks).code() == base::Code::InvalidArgument;
    };
    EXPECT_FALSE(refused([](ReferenceScene&, ReferenceSettings&) {}));
    EXPECT_TRUE(refused([](ReferenceScene& s, ReferenceSettings&) { s.blobs[1].radius = 0.0; }));
    EXPECT_TRUE(refused([](ReferenceScene& s, ReferenceSettings&) { s.blobs[1].center.y = NAN; }));
    EXPECT_TRUE(refused([](ReferenceScene& s, ReferenceSettings&) { s.blobs[2].source.z = -1.0; }));
    EXPECT_TRUE(refused([](ReferenceScene& s, ReferenceSettings&) { s.camera.up = glm::dvec3(0.0); }));
    EXPECT_TRUE(refused([](ReferenceScene& s, ReferenceSettings&) { s.camera.forward.x = NAN; }));
    EXPECT_TRUE(refused([](ReferenceScene& s, ReferenceSettings&) { s.camera.eye.y = INFINITY; }));
    EXPECT_TRUE(refused([](ReferenceScene& s, ReferenceSettings&) { s.camera.halfHeight = 0.0; }));
    EXPECT_TRUE(refused([](ReferenceScene&, ReferenceSettings& s) { s.width = 0; }));
    EXPECT_TRUE(refused([](ReferenceScene&, ReferenceSettings& s) { s.samples = 17; }));
}

TEST(ReferenceRenderer, countsValuesThatAreNoNumbersAndReplacesThem)
{
    ReferenceScene scene = test::blobScene(30, 2.0);
    EXPECT_EQ(test::Rendered(scene).renderer.work().nonFinite, 0u);
    for (MediumBlob& blob : scene.blobs)
        blob.source = glm::dvec3(1e60); // beyond the floats of the picture
    const test::Rendered picture(scene);
    uint64_t covered = 0;
    for (size_t i = 0; i < picture[0].size(); ++i) {
        for (uint32_t c = 0; c < channel::Count; ++c)
            EXPECT_TRUE(std::isfinite(picture[c][i]) || c == channel::Depth);
        EXPECT_FALSE(std::isnan(picture[channel::Depth][i]));
        if (picture[channel::Color + 3][i] > 1e-6f) {
            EXPECT_EQ(picture[channel::Color][i], 0.0f);
            ++covered;
        }
    }
    EXPECT_GE(picture.renderer.work().nonFinite, 6 * covered); // color and fire
    EXPECT_GT(covered, 100u);
}

TEST(ReferenceRenderer, theKeyChangesWithEverythingThatThePictureDependsOn)
{
    const auto tasks = base::makeSerialRunner();
    const auto keyWith = [&](auto change) {
        ReferenceScene scene = test::blobScene(3, 1.0);
        ReferenceSettings settings = test::smallSettings();
        change(scene, settings);
        ReferenceRenderer renderer;
        EXPECT_TRUE(renderer.build(scene, settings, *tasks).ok());
        return renderer.key();
    };
    std::vector<uint64_t> keys{
        keyWith([](ReferenceScene&, ReferenceSettings&) {}),
        keyWith([](ReferenceScene& s, ReferenceSettings&) { s.blobs[2].center.x += 1e-12; }),
        keyWith([](ReferenceScene& s, ReferenceSettings&) { s.blobs[2].fireShare *= 0.5; }),
        keyWith([](ReferenceScene& s, ReferenceSettings&) { s.blobs.pop_back(); }),
        keyWith([](ReferenceScene& s, ReferenceSettings&) { s.camera.halfHeight *= 1.0001; }),
        keyWith([](ReferenceScene& s, ReferenceSettings&) { s.opaque.background.horizon.y = 1.0f; }),
        keyWith([](ReferenceScene&, ReferenceSettings& s) { s.height += 1; }),
        keyWith([](ReferenceScene&, ReferenceSettings& s) { s.isSingle = true; }),
        keyWith([](ReferenceScene&, ReferenceSettings& s) { s.integral.scheme.cap = 0.5; }),
    };
    const uint64_t first = keys[0];
    EXPECT_EQ(first, keyWith([](ReferenceScene&, ReferenceSettings&) {}));
    std::sort(keys.begin(), keys.end());
    EXPECT_EQ(std::unique(keys.begin(), keys.end()), keys.end());
}

} // namespace
} // namespace fx::render
