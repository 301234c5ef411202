// Media in slabs across each ray: exact where one ball stands alone, and without an order where they overlap.
#include "rendering/reference/integral/reference_integral.h"
#include "tests/rendering/view/permutations.h"
#include "tests/rendering/view/view_fixture.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <random>

using namespace fx;
using namespace fx::test;

namespace {

constexpr int kWidth = 96, kHeight = 64;
const render::CameraPose kPose{{0.0, 0.0, 6.0}, {0.0, 0.0, 0.0}, {0.0f, 1.0f, 0.0f}};

class Slabs : public ViewTest
{
protected:
    void SetUp() override
    {
        ViewTest::SetUp();
        makeTargets(kWidth, kHeight);
        view_->settings().slabs = 16;
    }

    Picture drawn(const std::vector<TestBlob>& blobs, const render::CameraView& camera,
                  render::Composition composition = render::Composition::Slabs)
    {
        view_->settings().composition = composition;
        setPicture(std::vector<float>(size_t(color_->width()) * size_t(color_->height()) * 4, 0.0f));
        return render(snapshotOf(blobs), camera);
    }

    /// Of a view that sees little more than the cloud.
    render::CameraView closeCamera() { return render::perspectiveView(kPose, 0.5f, 1.5f, 0.1f); }

    /// Of a picture in slabs against the same drawn one over the other.
    double difference(const std::vector<TestBlob>& blobs, const render::CameraView& camera)
    {
        const Picture slabs = drawn(blobs, camera);
        const Picture sorted = drawn(blobs, camera, render::Composition::Sorted);
        EXPECT_GT(*std::max_element(sorted.texels.begin(), sorted.texels.end()), 0.05f)
            << "the ball must be in the picture";
        return maxDifference(slabs, sorted);
    }

    render::CameraView camera(float nearDistance = 0.1f)
    {
        return render::perspectiveView(kPose, 1.0f, float(kWidth) / kHeight, nearDistance);
    }
};

/// Balls within a ball of radius 1.
std::vector<TestBlob> cloud(size_t count, float radius, float opticalDepth)
{
    std::mt19937 random(7);
    std::uniform_real_distribution<float> side(-1.0f, 1.0f), share(0.0f, 1.0f);
    std::vector<TestBlob> blobs;
    while (blobs.size() < count) {
        const glm::vec3 p(side(random), side(random), side(random));
        if (glm::dot(p, p) > 1.0f)
            continue;
        TestBlob blob;
        blob.center = p;
        blob.radius = radius;
        blob.crossSection = opticalDepth * 3.14159265f * radius * radius / 3.5f;
        blob.emission = share(random);
        blobs.push_back(blob);
    }
    return blobs;
}

const TestBlob kBall{{0.1f, -0.2f, 0.0f}, 1.5f, 3.0f, 1.0f};

} // namespace

TEST_F(Slabs, aBallThatStandsAloneIsExact)
{
    EXPECT_LT(difference({kBall}, camera()), 2e-5);
    view_->settings().slabs = 6;
    EXPECT_LT(difference({kBall}, camera()), 2e-5);
}

TEST_F(Slabs, theEyeMayBeInsideABall)
{
    EXPECT_LT(difference({{{0.3f, 0.2f, 5.5f}, 1.5f, 3.0f, 1.0f}}, camera()), 2e-5);
}

TEST_F(Slabs, theNearPlaneCutsABall)
{
    EXPECT_LT(difference({{{0.3f, 0.2f, 3.9f}, 0.6f, 0.6f, 1.0f}}, camera(2.0f)), 2e-5);
}

TEST_F(Slabs, anOpaqueSurfaceCutsABall)
{
    setDepth(std::vector<float>(size_t(kWidth) * kHeight, 1.0f - 0.1f / 5.8f));
    EXPECT_LT(difference({kBall}, camera()), 2e-5);
}

namespace {

/// Exact light along the ray of each pixel of a parallel view that is 3 m high, rows from the bottom.
std::vector<double> exactLight(const std::vector<TestBlob>& blobs)
{
    const auto exponential = [](double x) { return std::exp(x); };
    const auto root = [](double x) { return std::sqrt(x); };
    std::vector<double> lights;
    for (int i = 0; i < kWidth * kHeight; ++i) {
        const double x = (i % kWidth + 0.5 - 0.5 * kWidth) * 3.0 / kHeight;
        const double y = (i / kWidth + 0.5 - 0.5 * kHeight) * 3.0 / kHeight;
        std::vector<render::RayBlob<double>> met;
        for (const TestBlob& blob : blobs) {
            const double dx = double(blob.center.x) - x, dy = double(blob.center.y) - y,
                         r = double(blob.radius);
            const double chord2 = r * r - dx * dx - dy * dy;
            const double e = double(blob.emission);
            if (chord2 > 0.0)
                met.push_back({6.0 - double(blob.center.z),
                               chord2,
                               r,
                               double(blob.crossSection) * 1.04445431404056 / (r * r * r),
                               {e, e, e},
                               uint32_t(met.size())});
        }
        render::ReferenceIntegral<double, decltype(exponential)> integral(
            met, {0.0, std::numeric_limits<double>::infinity(), {}}, 2, false, 1e-9, root, exponential);
        lights.push_back(integral.light()[0]);
    }
    return lights;
}

} // namespace

TEST_F(Slabs, ballsThatOverlapAreTheIntegralThroughTheirSum)
{
    const std::vector<TestBlob> blobs = cloud(100, 0.4f, 0.3f);
    const std::vector<double> exact = exactLight(blobs);
    const double brightest = *std::max_element(exact.begin(), exact.end());
    const auto view = render::orthographicView(kPose, 3.0f, float(kWidth) / kHeight, 0.0f, 20.0f);
    const auto p99 = [&](const Picture& picture) {
        std::vector<double> errors;
        for (size_t i = 0; i < exact.size(); ++i)
            if (exact[i] > 1e-3 * brightest)
                errors.push_back(std::abs(double(picture.texels[4 * i]) / exact[i] - 1.0));
        std::sort(errors.begin(), errors.end());
        return errors[errors.size() * 99 / 100];
    };
    EXPECT_LT(p99(drawn(blobs, view)), 1e-3);
    view_->settings().slabs = 6;
    EXPECT_LT(p99(drawn(blobs, view)), 0.02);
    EXPECT_GT(p99(drawn(blobs, view, render::Composition::Sorted)), 0.03)
        << "the control: one over the other is not the integral";
}

TEST_F(Slabs, aFaintBallFarBehindDoesNotMakeTheOthersCoarse)
{
    std::vector<TestBlob> blobs = cloud(40, 0.6f, 0.4f);
    blobs.push_back({{0.0f, 0.0f, -60.0f}, 2.0f, 0.1f, 0.0f});
    const std::vector<double> exact = exactLight(blobs);
    for (const int slabs : {6, 16}) {
        view_->settings().slabs = slabs;
        const Picture picture =
            drawn(blobs, render::orthographicView(kPose, 3.0f, float(kWidth) / kHeight, 0.0f, 100.0f));
        double largest = 0.0;
        for (size_t i = 0; i < exact.size(); ++i)
            largest = std::max(largest, std::abs(double(picture.texels[4 * i]) - exact[i]));
        EXPECT_LT(largest, slabs == 6 ? 0.06 : 0.02) << slabs;
    }
}

TEST_F(Slabs, noOrderOfBallsIsSeen)
{
    makeTargets(24, 16);
    std::vector<TestBlob> blobs = cloud(270, 0.3f, 0.5f);
    const Picture first = drawn(blobs, closeCamera());
    const float brightest = *std::max_element(first.texels.begin(), first.texels.end());
    std::mt19937 random(1);
    double most = 0.0;
    for (int i = 0; i < permutations(); ++i) {
        std::shuffle(blobs.begin(), blobs.end(), random);
        most = std::max(most, maxDifference(drawn(blobs, closeCamera()), first));
    }
    std::printf("%d orders: largest change %.1e of the brightest value\n", permutations(),
                most / double(brightest));
    EXPECT_LT(most, double(brightest) / 1023.0);
}

TEST_F(Slabs, layersAreThoseOfOneBallOverTheOther)
{
    TestBlob fire = kBall, dust = kBall;
    fire.center.z = 2.0f;
    fire.radius = dust.radius = 0.8f;
    fire.fireShare = 0.7f;
    dust.center.z = -2.0f;
    dust.layer = base::MediaLayer::Dust;
    dust.emission = 0.0f;
    dust.albedo = 0.6f;
    view_->settings().layerOutputs = true;
    view_->settings().lighting.skyLuminance = glm::vec3(0.4f);
    const auto textures = [&](render::Composition composition) {
        drawn({fire, dust}, camera(), composition);
        const render::LayerTextures layers = view_->layers();
        return std::vector<Picture>{read(layers.fire),  read(layers.smoke),    read(layers.dust),
                                    read(layers.media), read(layers.depth, 1), read(layers.opticalDepth, 1)};
    };
    const auto slabs = textures(render::Composition::Slabs);
    const auto sorted = textures(render::Composition::Sorted);
    // light of a ball has a slope; sorted guesses the distance [m] within a ball
    const double limits[] = {2e-3, 2e-3, 2e-3, 2e-3, 0.3, 1e-4};
    for (size_t k = 0; k < slabs.size(); ++k) {
        double most = 0.0;
        for (size_t i = 0; i < slabs[k].texels.size(); ++i)
            if (std::isfinite(sorted[k].texels[i]))
                most = std::max(most, std::abs(double(slabs[k].texels[i] - sorted[k].texels[i])));
        EXPECT_LT(most, limits[k]) << "texture " << k;
    }
}

TEST_F(Slabs, theDepthLayerIsTheMeanDistanceOfWhatIsSeen)
{
    view_->settings().layerOutputs = true;
    drawn({kBall}, render::orthographicView(kPose, 3.0f, float(kWidth) / kHeight, 0.0f, 20.0f));
    const Picture depth = read(view_->layers().depth, 1);
    for (const int row : {10, 24, 40}) {
        const double dx = 0.5 * 3.0 / kHeight - double(kBall.center.x);
        const double dy = (row + 0.5 - 0.5 * kHeight) * 3.0 / kHeight - double(kBall.center.y);
        double passed = 0.0, seen = 0.0, moment = 0.0;
        constexpr int kSteps = 20000;
        for (int i = 0; i < kSteps; ++i) { // from the definition of the kernel
            const double z = 1.5 * (2.0 * (i + 0.5) / kSteps - 1.0), r = 1.5;
            const double q = std::max(1.0 - (dx * dx + dy * dy + z * z) / (r * r), 0.0);
            const double step =
                3.0 * 105.0 / (32.0 * 3.14159265358979 * r * r * r) * q * q * 2.0 * r / kSteps;
            const double part = std::exp(-passed) * -std::expm1(-step);
            passed += step;
            seen += part;
            moment += part * (6.0 + z);
        }
        EXPECT_NEAR(double(depth.texels[size_t(row * kWidth + kWidth / 2)]), moment / seen, 2e-3) << row;
    }
}

TEST_F(Slabs, aPlaneOfDepthSplitsTheTransmittanceIntoAProduct)
{
    const std::vector<TestBlob> blobs = cloud(60, 0.5f, 0.4f);
    const auto alphas = [&](float nearDistance, float farStored) {
        const auto view = render::orthographicView(kPose, 3.0f, float(kWidth) / kHeight, nearDistance, 20.0f);
        setDepth(std::vector<float>(size_t(kWidth) * kHeight, farStored));
        return drawn(blobs, view);
    };
    const float middle = 6.1f; // [m]
    const Picture whole = alphas(0.5f, 1.0f);
    const Picture before = alphas(0.5f, (middle - 0.5f) / 19.5f);
    const Picture behind = alphas(middle, 1.0f);
    for (size_t i = 3; i < whole.texels.size(); i += 4) {
        const float product = (1.0f - before.texels[i]) * (1.0f - behind.texels[i]);
        ASSERT_NEAR(1.0f - whole.texels[i], product, 2e-4f);
    }
}

TEST_F(Slabs, aFurnaceIsAsBrightAsItsGas)
{
    std::vector<TestBlob> blobs = cloud(270, 0.4f, 2.0f);
    for (TestBlob& blob : blobs)
        blob.emission = 0.7f;
    const Picture picture = drawn(blobs, camera());
    float thickest = 0.0f;
    for (size_t i = 0; i < picture.texels.size(); i += 4) {
        const float alpha = picture.texels[i + 3];
        thickest = std::max(thickest, alpha);
        ASSERT_NEAR(picture.texels[i], 0.7f * alpha, 1e-4f);
    }
    EXPECT_GT(thickest, 0.999f);
}

TEST_F(Slabs, smallLayersAreThoseOfOneBall)
{
    for (const int divisor : {2, 4}) {
        view_->settings().layerDivisor = divisor;
        EXPECT_LT(difference({kBall}, camera()), 1e-4) << divisor;
        setDepth([&] { // a pillar
            std::vector<float> stored(size_t(kWidth) * kHeight, 1.0f);
            for (size_t i = 0; i < stored.size(); ++i)
                stored[i] = int(i) % kWidth / 9 % 2 == 0 ? 1.0f - 0.1f / 5.8f : 1.0f;
            return stored;
        }());
        EXPECT_LT(difference({kBall}, camera()), 1e-4) << divisor;
    }
}

TEST_F(Slabs, thousandsOfBallsInOneTileAreTheOneBall)
{
    makeTargets(8, 8);
    TestBlob whole = kBall;
    whole.center = glm::vec3(0.0f);
    for (const bool layers : {false, true})
        for (const int slabs : {6, 16}) {
            view_->settings().slabs = slabs;
            view_->settings().layerOutputs = layers;
            const Picture alone = drawn({whole}, camera());
            ASSERT_GT(*std::max_element(alone.texels.begin(), alone.texels.end()), 0.5f);
            for (const size_t count : {3000u, 20000u}) { // a list holds 15,000
                TestBlob part = whole;
                part.crossSection /= float(count);
                EXPECT_LT(maxDifference(drawn(std::vector<TestBlob>(count, part), camera()), alone), 2e-3)
                    << count << " balls, " << slabs << " slabs, layers " << layers;
            }
        }
}

TEST_F(Slabs, aTileListsFourteenThousandBallsWithoutAChoice)
{
    makeTargets(8, 8);
    view_->settings().countOverdraw = true;
    TestBlob part = kBall;
    part.crossSection *= 1e-4f;
    for (const int slabs : {6, 16}) {
        view_->settings().slabs = slabs;
        drawn(std::vector<TestBlob>(14000, part), camera());
        EXPECT_EQ(view_->statistics().listedBalls, 14000u) << slabs;
        EXPECT_EQ(view_->statistics().spilledBalls, 0u) << slabs;
    }
}

TEST_F(Slabs, theChoiceOfACrowdedTileStaysInAnyOrderAndWhenOthersDie)
{
    makeTargets(16, 16);
    std::mt19937 random(6);
    std::uniform_real_distribution<float> place(-1.0f, 1.0f), bright(0.0f, 1.0f);
    std::vector<TestBlob> balls;
    constexpr uint64_t kBalls = 20001; // more than a list holds
    for (uint64_t id = 0; id < kBalls; ++id) {
        balls.push_back({{place(random), place(random), place(random)}, 0.2f, 0.0008f, bright(random)});
        balls.back().id = id;
    }
    view_->settings().slabs = 16;
    const Picture all = drawn(balls, camera());
    std::ranges::shuffle(balls, random);
    EXPECT_LT(maxDifference(drawn(balls, camera()), all), 1e-4) << "in another order";
    balls.pop_back();
    EXPECT_LT(maxDifference(drawn(balls, camera()), all), 0.01) << "without one";
}

TEST_F(Slabs, ballsLeaveTheChoiceOfACrowdedTileSmoothly)
{
    // thousands of equal balls at one place, few of which send light: what is seen changes with their weights
    makeTargets(4, 4);
    view_->settings().slabs = 16;
    constexpr size_t kFewest = 12600, kMost = 17500, kStep = 700; // a list holds 15,000
    TestBlob ball = kBall;
    ball.center = glm::vec3(0.0f);
    ball.crossSection = 1.4e-5f;
    ball.emission = 0.0f;
    double worst = 0.0, most = 0.0, last = -1.0;
    for (size_t count = kFewest; count <= kMost; count += kStep) {
        std::vector<TestBlob> balls(count, ball);
        for (size_t id = 0; id < 8; ++id)
            balls[id].emission = 1e4f;
        const Picture picture = drawn(balls, camera());
        const double light = double(picture.at(2, 2)[0]);
        worst = last < 0.0 ? 0.0 : std::max(worst, std::abs(light - last));
        most = std::max(most, light);
        last = light;
    }
    EXPECT_LT(worst, 0.1 * most);
}

TEST_F(Slabs, picturesRepeatBitForBit)
{
    const std::vector<TestBlob> blobs = cloud(100, 0.4f, 0.3f);
    EXPECT_EQ(drawn(blobs, camera()).texels, drawn(blobs, camera()).texels);
}

TEST_F(Slabs, onlyTilesWithBallsAreListed)
{
    view_->settings().countOverdraw = true;
    TestBlob small{{0.0f, 0.0f, 0.0f}, 0.05f, 0.01f, 1.0f};
    drawn({small}, camera());
    EXPECT_GE(view_->statistics().listedBalls, 1u);
    EXPECT_LE(view_->statistics().listedBalls, 4u);
    EXPECT_EQ(view_->statistics().spilledBalls, 0u);
    small.center.x = 100.0f; // gathered for no tile
    drawn({small, kBall}, camera());
    EXPECT_LE(view_->statistics().listedBalls, uint64_t(kWidth / 16 * kHeight / 16));
}

TEST_F(Slabs, aCompositionThatIsNotThereIsRefused)
{
    view_->settings().composition = render::Composition(200);
    render::FrameRequest request;
    request.camera = camera();
    request.targets = {color_->name(), 0, 0, false, kWidth, kHeight};
    const auto snapshot = snapshotOf({kBall});
    EXPECT_EQ(view_->render({&snapshot, nullptr}, request).code(), base::Code::InvalidArgument);
}
