// Soil and hills as OpenGL draws them, against the surfaces of the reference renderer.
#include "rendering/reference/render/opaque_view.h"
#include "rendering/reference/render/soil_surface.h"
#include "rendering/reference/trace/ray_query.h"
#include "rendering/stage/stage_renderer.h"
#include "tests/rendering/view/view_fixture.h"

#include <cmath>
#include <numbers>

using namespace fx;
using namespace fx::test;

namespace {

constexpr int kSize = 96;
constexpr float kFieldOfView = 0.7f; // [rad]
constexpr float kSide = 3000.0f;     // [m] half of the ground's side

class StageGround : public ViewTest
{
protected:
    void SetUp() override
    {
        ViewTest::SetUp();
        makeTargets(kSize, kSize);
        const glm::vec3 corner[] = {
            {-kSide, 0, kSide}, {kSide, 0, kSide}, {kSide, 0, -kSide}, {-kSide, 0, -kSide}};
        for (const int i : {0, 1, 2, 0, 2, 3}) {
            mesh_.positions.push_back(corner[i]);
            mesh_.normals.emplace_back(0.0f, 1.0f, 0.0f);
            mesh_.colors.emplace_back(0.2f);
        }
        mesh_.isSoil = true;
        background_.luminance = {1600.0f, 2600.0f, 4600.0f};
        background_.horizon = {5200.0f, 5700.0f, 6100.0f};
        background_.hasHills = true;
        lighting_.sunDirection = glm::normalize(glm::vec3(0.55f, 0.5f, 0.45f));
        lighting_.sunIlluminance = glm::vec3(40000.0f);
        lighting_.skyLuminance = glm::vec3(3000.0f);
    }

    /// [cd/m2] Picture of the stage, rows from the bottom.
    Picture drawn(const glm::dvec3& eye, const glm::dvec3& target)
    {
        render::StageRenderer stage(device_.get());
        EXPECT_TRUE(stage.setMesh(mesh_).ok());
        EXPECT_TRUE(stage.setBackground(background_).ok());
        const auto camera =
            render::perspectiveView({eye, target, {0.0f, 1.0f, 0.0f}}, kFieldOfView, 1.0f, 0.1f);
        EXPECT_TRUE(stage.render(camera, lighting_, {}, kEv100, kSize, kSize).ok());
        Picture picture{kSize, kSize, {}};
        picture.texels = read(stage.colorTexture()).texels;
        for (float& texel : picture.texels)
            texel *= 1.2f * std::exp2(kEv100);
        return picture;
    }

    /// [cd/m2] Picture of the reference, rows from the bottom.
    Picture traced(const glm::dvec3& eye, const glm::dvec3& target)
    {
        render::OpaqueScene scene;
        scene.mesh = {mesh_.origin, mesh_.positions, mesh_.normals, mesh_.colors, mesh_.isSoil};
        scene.background.luminance = background_.luminance;
        scene.background.horizon = background_.horizon;
        scene.background.hasHills = background_.hasHills;
        scene.lighting = lighting_;
        auto camera = render::ReferenceCamera::lookAt(eye, target, {0.0, 1.0, 0.0});
        camera.halfHeight = std::tan(0.5 * double(kFieldOfView));
        const auto tasks = base::makeSerialRunner();
        render::OpaqueView view;
        view.build(scene, eye, *tasks, render::PixelWidth(camera, kSize));
        const render::RayGrid grid = camera.grid(kSize, kSize);
        Picture picture{kSize, kSize, {}};
        render::RayHits hits, scratch;
        for (int y = kSize - 1; y >= 0; --y)
            for (int x = 0; x < kSize; ++x) {
                const render::TraceRay ray = grid.ray(x + 0.5, y + 0.5, nullptr);
                render::findHits(view.tree(), ray, 0.0, 1e30, hits);
                const glm::dvec3 light = view.sample(ray, 0.5, 0.5, hits, 0.0, scratch).luminance;
                for (const double channel : {light.x, light.y, light.z, 1.0})
                    picture.texels.push_back(float(channel));
            }
        return picture;
    }

    render::StageMesh mesh_;
    render::StageBackground background_;
    render::Lighting lighting_;
};

/// Root mean square difference of luminances over the root mean square.
double difference(const Picture& a, const Picture& b, int from, int to)
{
    double squares = 0.0, whole = 0.0;
    for (int y = from; y < to; ++y)
        for (int x = 0; x < kSize; ++x)
            for (int c = 0; c < 3; ++c) {
                const double d = double(a.at(x, y)[c]) - double(b.at(x, y)[c]);
                squares += d * d;
                whole += double(b.at(x, y)[c]) * double(b.at(x, y)[c]);
            }
    return std::sqrt(squares / whole);
}

/// Deviation of a channel over its mean.
double contrast(const Picture& a, int from, int to)
{
    double sum = 0.0, squares = 0.0;
    for (int y = from; y < to; ++y)
        for (int x = 0; x < kSize; ++x) {
            sum += double(a.at(x, y)[1]);
            squares += double(a.at(x, y)[1]) * double(a.at(x, y)[1]);
        }
    const double count = double(kSize) * (to - from), mean = sum / count;
    return std::sqrt(std::max(squares / count - mean * mean, 0.0)) / mean;
}

} // namespace

TEST_F(StageGround, seenFromAboveItIsThatOfTheReference)
{
    // off the axis OpenGL takes the image of a pixel from derivatives, the reference from the slant of the
    // ray
    const glm::dvec3 eye(40.0, 6.0, -25.0), target(40.0, 0.0, -25.01);
    EXPECT_LT(difference(drawn(eye, target), traced(eye, target), 0, kSize), 0.03);
}

TEST_F(StageGround, seenAlongItIsThatOfTheReference)
{
    const glm::dvec3 eye(3.0, 1.7, 12.0), target(0.0, 1.3, 0.0);
    EXPECT_LT(difference(drawn(eye, target), traced(eye, target), 0, kSize / 3), 0.05);
}

TEST_F(StageGround, hillsAreThoseOfTheReference)
{
    const glm::dvec3 eye(3.0, 1.7, 12.0), target(0.0, 1.9, 0.0);
    EXPECT_LT(difference(drawn(eye, target), traced(eye, target), kSize / 2, kSize), 0.002);
}

TEST_F(StageGround, theOutlineOfHillsHasNoSteps)
{
    const glm::dvec3 eye(0.0, 1.7, 0.0), target(0.0, 1.7, -10.0);
    const Picture picture = drawn(eye, target);
    int between = 0;
    for (int x = 0; x < kSize; ++x)
        for (int y = kSize / 2; y + 2 < kSize; ++y) {
            const float below = picture.at(x, y)[0], here = picture.at(x, y + 1)[0],
                        above = picture.at(x, y + 2)[0];
            between += here > below + 0.1f * (above - below) && here < above - 0.1f * (above - below) &&
                       above > 1.2f * below;
        }
    EXPECT_GT(between, kSize / 2); // of two outlines in each column
}

TEST_F(StageGround, noPixelAtTheHorizonIsDark)
{
    for (const double height : {0.3, 1.7, 30.0}) {
        const Picture picture = traced({0.0, height, 0.0}, {0.0, height, -10.0});
        for (int y = 0; y < kSize; ++y)
            for (int x = 0; x < kSize; ++x)
                ASSERT_GT(picture.at(x, y)[1], 300.0f) << x << ' ' << y << " from " << height << " m";
    }
}

TEST_F(StageGround, contrastFadesWithDistanceAndTheMeanStays)
{
    const auto above = [&](double height) { return drawn({5.0, height, 5.0}, {5.0, 0.0, 4.99}); };
    const Picture near = above(2.0), far = above(600.0);
    EXPECT_GT(contrast(near, 0, kSize), 0.1);
    EXPECT_LT(contrast(far, 0, kSize), 0.5 * contrast(near, 0, kSize));
    const double flat = 0.2 * (40000.0 * double(lighting_.sunDirection.y) * std::numbers::inv_pi + 3000.0);
    double sum = 0.0;
    for (int i = 0; i < kSize * kSize; ++i)
        sum += double(far.texels[size_t(i) * 4 + 1]) / (kSize * kSize);
    EXPECT_NEAR(sum / flat, 1.0, 0.03);
}

TEST(SoilSurface, taperedPixelsAverageAlongTheirLongAxis)
{
    // the mean over a long pixel is that of short ones beside each other
    const glm::dvec2 along(0.9, 0.3);
    double error = 0.0, alone = 0.0;
    for (int i = 0; i < 400; ++i) {
        const glm::dvec2 place(0.37 * i, 0.11 * i);
        double mean = 0.0;
        for (double t = 0.5; t < 32.0; ++t)
            mean += render::soilAt(place + along * (t / 32.0 - 0.5), glm::dvec2(0.0), 0.1).share.y / 32.0;
        const double seen = render::soilAt(place, along, 0.1).share.y;
        error += (seen - mean) * (seen - mean);
        alone += (mean - 1.0) * (mean - 1.0);
    }
    EXPECT_LT(error, 0.2 * alone);
}
