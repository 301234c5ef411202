/// Whole pictures: against the reference renderer, against themselves on more threads or resumed, and their
/// errors.

#include "rendering/reference/path/path_renderer.h"

#include "tests/rendering/reference/render/reference_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace fx::render {
namespace {

/// 60 blobs of smoke in the sun.
ReferenceScene sunnySmoke()
{
    ReferenceScene scene = test::blobScene(60, 2.0);
    for (MediumBlob& blob : scene.blobs) {
        blob.albedo = {0.9, 0.7, 0.4};
        blob.anisotropy = 0.5;
        blob.source *= 0.05;
        blob.fireShare = 0.0;
    }
    scene.opaque.lighting.sunDirection = glm::normalize(glm::vec3(0.4f, 0.8f, -0.2f));
    scene.opaque.lighting.sunIlluminance = glm::vec3(3.0f, 2.5f, 2.0f);
    scene.opaque.lighting.groundAlbedo = 0.0f;
    return scene;
}

PathPictureSettings smallPicture(uint32_t samples)
{
    PathPictureSettings settings;
    settings.width = 42;
    settings.height = 27;
    settings.samples = samples;
    return settings;
}

struct Picture
{
    Picture(const ReferenceScene& scene, const PathPictureSettings& settings, uint32_t threads = 1)
    {
        const auto tasks = threads == 1 ? base::makeSerialRunner() : base::makeTbbRunner(threads);
        const base::Status built = renderer.build(scene, settings, *tasks);
        EXPECT_TRUE(built.ok()) << built.message();
        EXPECT_TRUE(renderer.render(nullptr, {}).ok());
    }
    const std::vector<float>& operator[](uint32_t channel) const { return renderer.pixels(channel); }

    PathRenderer renderer;
};

std::vector<std::vector<float>> planesOf(const PathRenderer& renderer)
{
    std::vector<std::vector<float>> planes;
    for (uint32_t channel = 0; channel < path_channel::Count; ++channel)
        planes.push_back(renderer.pixels(channel));
    return planes;
}

/// Whether nearly all pixels differ by no more than their errors allow, and their sum hardly. Where next to
/// no path collides, its error is not known either, so pixels of less opacity than 2 % count in the sum only.
void expectSame(const Picture& paths, const test::Rendered& expected)
{
    size_t compared = 0, agreeing = 0;
    double difference = 0.0, light = 0.0;
    for (uint32_t channel = 0; channel < 3; ++channel)
        for (size_t i = 0; i < paths[0].size(); ++i) {
            const double wanted = expected[reference_channel::Color + channel][i];
            const double error = std::sqrt(double(paths[path_channel::Variance + channel][i]));
            difference += paths[channel][i] - wanted;
            light += wanted;
            if (expected[reference_channel::Color + 3][i] < 0.02f)
                continue;
            ++compared;
            agreeing += std::abs(paths[channel][i] - wanted) <= 3.0 * error + 2e-3 * wanted;
        }
    EXPECT_GT(compared, 1000u);
    EXPECT_GE(double(agreeing), 0.99 * double(compared));
    EXPECT_NEAR(difference / light, 0.0, 3e-3);
    for (size_t i = 0; i < paths[0].size(); ++i)
        EXPECT_NEAR(paths[path_channel::Color + 3][i], expected[reference_channel::Color + 3][i], 0.02);
}

TEST(PathRenderer, oneScatteringIsTheReferenceRenderersSingleScattering)
{
    ReferenceScene scene = sunnySmoke();
    for (MediumBlob& blob : scene.blobs) // gas that glows lights other gas here, and by a few lights there
        blob.source = glm::dvec3(0.0);
    PathPictureSettings settings = smallPicture(96);
    settings.path.bounces = 1;
    settings.sunRadius = 0.0;
    ReferenceSettings reference = test::smallSettings();
    reference.scattering = ScatteringMode::Single;
    reference.samples = 12;
    expectSame(Picture(scene, settings), test::Rendered(scene, reference));
}

TEST(PathRenderer, noScatteringIsTheReferenceRenderersEmission)
{
    PathPictureSettings settings = smallPicture(512);
    settings.path.bounces = 0;
    ReferenceSettings reference = test::smallSettings();
    reference.samples = 16;
    expectSame(Picture(test::blobScene(60, 2.0), settings),
               test::Rendered(test::blobScene(60, 2.0), reference));
}

TEST(PathRenderer, moreScatteringsBrightenSmoke)
{
    PathPictureSettings settings = smallPicture(32);
    const Picture all(sunnySmoke(), settings);
    settings.path.bounces = 1;
    const Picture one(sunnySmoke(), settings);
    double ofAll = 0.0, ofOne = 0.0;
    for (size_t i = 0; i < all[0].size(); ++i) {
        ofAll += all[0][i];
        ofOne += one[0][i];
    }
    EXPECT_GT(ofAll, 1.2 * ofOne);
}

TEST(PathRenderer, sunlitGroundIsWhatTheReferenceRendererShows)
{
    const std::vector<glm::vec3> positions{{-4, -1, -4}, {-4, -1, 4}, {4, -1, -4},
                                           {4, -1, -4},  {-4, -1, 4}, {4, -1, 4}};
    const std::vector<glm::vec3> normals(6, {0, 1, 0}), colors(6, {0.5f, 0.3f, 0.1f});
    ReferenceScene scene = sunnySmoke();
    scene.blobs.clear();
    scene.opaque.isEmpty = false;
    scene.opaque.mesh = {glm::dvec3(0.0), positions, normals, colors};
    scene.camera = ReferenceCamera::lookAt({0.0, 3.0, 0.1}, {0.0, -1.0, 0.0}, {0.0, 0.0, -1.0});
    PathPictureSettings settings = smallPicture(4);
    settings.sunRadius = 0.0;
    const Picture paths(scene, settings);
    const test::Rendered expected(scene);
    for (uint32_t channel = 0; channel < 3; ++channel)
        for (size_t i = 0; i < paths[0].size(); ++i) {
            EXPECT_NEAR(paths[channel][i], expected[channel][i], 1e-5 * expected[channel][i]);
            EXPECT_EQ(paths[path_channel::Color + 3][i], 1.0f);
        }
}

TEST(PathRenderer, smokeShadowsTheGroundBelowIt)
{
    const std::vector<glm::vec3> positions{{-9, -2, -9}, {-9, -2, 9}, {9, -2, -9},
                                           {9, -2, -9},  {-9, -2, 9}, {9, -2, 9}};
    const std::vector<glm::vec3> normals(6, {0, 1, 0}), colors(6, glm::vec3(0.5f));
    ReferenceScene scene = sunnySmoke();
    for (MediumBlob& blob : scene.blobs) {
        blob.crossSection *= 10.0;
        blob.albedo = glm::dvec3(0.0);
        blob.source = glm::dvec3(0.0);
    }
    scene.opaque.isEmpty = false;
    scene.opaque.mesh = {glm::dvec3(0.0), positions, normals, colors};
    scene.opaque.lighting.sunDirection = {0, 1, 0};
    scene.camera = ReferenceCamera::lookAt({6.0, -1.0, 0.0}, {0.0, -2.0, 0.0}, {0.0, 1.0, 0.0});
    scene.camera.halfHeight = 0.02; // the ground under the smoke only
    const Picture paths(scene, smallPicture(4));
    const size_t middle = size_t(42 * 13 + 21);
    EXPECT_LT(paths[0][middle], 0.05 * 3.0 * 0.5 / 3.14159);
}

TEST(PathRenderer, hasTheSameBitsOnAnyNumberOfThreads)
{
    const ReferenceScene scene = sunnySmoke();
    PathPictureSettings settings = smallPicture(64);
    settings.error = 0.02;
    const auto one = planesOf(Picture(scene, settings, 1).renderer);
    for (const uint32_t threads : {2u, 4u})
        EXPECT_EQ(planesOf(Picture(scene, settings, threads).renderer), one) << threads;
}

TEST(PathRenderer, aStoppedPictureGoesOnToTheSameBits)
{
    const ReferenceScene scene = sunnySmoke();
    const PathPictureSettings settings = smallPicture(8);
    const Picture whole(scene, settings);
    const auto tasks = base::makeSerialRunner();
    const std::filesystem::path file =
        std::filesystem::path(::testing::TempDir()) / "path_renderer_resume.journal";
    uint32_t stops = 0;
    for (uint32_t stopAt = 1;; stopAt += 5) {
        PathRenderer renderer;
        ASSERT_TRUE(renderer.build(scene, settings, *tasks).ok());
        EXPECT_EQ(renderer.key(), whole.renderer.key());
        TileJournal journal(file.string(), renderer.key());
        const auto restore = [&](uint32_t tile, std::span<const float> values) {
            renderer.restore(tile, values);
        };
        ASSERT_TRUE((stops == 0 ? journal.start() : journal.resume(restore)).ok());
        uint32_t done = 0;
        RenderCallbacks callbacks;
        callbacks.progress = [&](uint32_t now, uint32_t) { done = now; };
        callbacks.shouldStop = [&] { return done >= stopAt; };
        const base::Status status = renderer.render(&journal, callbacks);
        if (status.ok()) {
            EXPECT_EQ(planesOf(renderer), planesOf(whole.renderer));
            journal.remove();
            break;
        }
        ASSERT_EQ(status.code(), base::Code::Interrupted);
        ++stops;
    }
    EXPECT_GE(stops, 4u);
}

TEST(PathRenderer, takesTheSamplesThatTheErrorAsksFor)
{
    PathPictureSettings settings = smallPicture(4096);
    settings.error = 0.01;
    const Picture picture(sunnySmoke(), settings);
    EXPECT_LT(picture.renderer.standardError(), 1.15 * settings.error);
    const auto& samples = picture[path_channel::Samples];
    EXPECT_EQ(*std::min_element(samples.begin(), samples.end()),
              float(PathRenderer::kPilotSamples)); // empty corners
    EXPECT_GT(*std::max_element(samples.begin(), samples.end()), 2.0f * PathRenderer::kPilotSamples);
}

TEST(PathRenderer, statesAVarianceThatCoversTheDifferenceOfTwoPictures)
{
    PathPictureSettings settings = smallPicture(32);
    const Picture first(sunnySmoke(), settings);
    settings.seed = 2;
    const Picture second(sunnySmoke(), settings);
    double squares = 0.0, stated = 0.0;
    for (uint32_t channel = 0; channel < 3; ++channel)
        for (size_t i = 0; i < first[0].size(); ++i) {
            const double difference = double(first[channel][i]) - double(second[channel][i]);
            squares += difference * difference;
            stated +=
                first[path_channel::Variance + channel][i] + second[path_channel::Variance + channel][i];
        }
    EXPECT_LT(squares, 1.1 * stated);
    EXPECT_GT(squares, 0.2 * stated); // strata only lower it
}

TEST(PathRenderer, refusesNumbersOutsideTheirRange)
{
    const auto tasks = base::makeSerialRunner();
    const auto codeOf = [&](auto change) {
        PathPictureSettings settings = smallPicture(1);
        ReferenceScene scene = sunnySmoke();
        change(settings, scene);
        return PathRenderer().build(scene, settings, *tasks).code();
    };
    using S = PathPictureSettings&;
    using R = ReferenceScene&;
    EXPECT_EQ(codeOf([](S, R) {}), base::Code::Ok);
    const auto refused = base::Code::InvalidArgument;
    EXPECT_EQ(codeOf([](S s, R) { s.samples = 0; }), refused);
    EXPECT_EQ(codeOf([](S s, R) { s.width = 0; }), refused);
    EXPECT_EQ(codeOf([](S s, R) { s.error = -1.0; }), refused);
    EXPECT_EQ(codeOf([](S s, R) { s.error = std::nan(""); }), refused);
    EXPECT_EQ(codeOf([](S s, R) { s.exposure = 0.0; }), refused);
    EXPECT_EQ(codeOf([](S s, R) { s.sunRadius = 4.0; }), refused);
    EXPECT_EQ(codeOf([](S, R r) { r.blobs[3].radius = 0.0; }), refused);
    EXPECT_EQ(codeOf([](S, R r) { r.camera.halfHeight = std::nan(""); }), refused);
}

} // namespace
} // namespace fx::render
