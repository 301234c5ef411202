// An eye within media that are summed up in voxels: small balls near it are summed up exactly, and whole.
#include "rendering/reference/integral/reference_integral.h"
#include "tests/rendering/view/view_fixture.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <random>
#include <string>

using namespace fx;
using namespace fx::test;

namespace {

constexpr int kWidth = 16, kHeight = 9;

class VolumeNear : public ViewTest
{
protected:
    void SetUp() override
    {
        ViewTest::SetUp();
        makeTargets(kWidth, kHeight);
        view_->settings().composition = render::Composition::Volume;
    }

    Picture drawn(const base::FrameSnapshot& snapshot, const render::CameraView& camera)
    {
        setPicture(std::vector<float>(size_t(kWidth) * kHeight * 4, 0.0f));
        return render(snapshot, camera);
    }

    bool executed(std::string_view pass) const
    {
        return std::ranges::count(view_->executedPasses(), pass) > 0;
    }
};

/// Radii of 2 to 4 voxels if these are 0.15 m; mean free paths of 1 to 5 cm.
std::vector<TestBlob> denseBalls()
{
    std::mt19937 random(11);
    std::uniform_real_distribution<float> side(-1.0f, 1.0f), radius(0.3f, 0.6f), light(0.0f, 1.0f);
    std::vector<TestBlob> blobs;
    for (int b = 0; b < 70; ++b) {
        TestBlob blob;
        blob.center = {side(random), side(random), side(random)};
        blob.radius = radius(random);
        blob.crossSection = 60.0f * blob.radius * blob.radius * blob.radius;
        blob.emission = light(random);
        blobs.push_back(blob);
    }
    return blobs;
}

/// Exact light of the pixels of a view from within media, in any order.
std::vector<double> exactLight(const std::vector<TestBlob>& blobs, const render::CameraPose& pose, float fovY,
                               float nearDistance)
{
    const auto exponential = [](double x) { return std::exp(x); };
    const auto root = [](double x) { return std::sqrt(x); };
    const glm::dvec3 forward = glm::normalize(pose.target - pose.position);
    const glm::dvec3 right = glm::normalize(glm::cross(forward, glm::dvec3(pose.up)));
    const glm::dvec3 up = glm::cross(right, forward);
    const double slope = std::tan(0.5 * double(fovY));
    std::vector<double> lights;
    for (int i = 0; i < kWidth * kHeight; ++i) {
        const double x = (2.0 * (i % kWidth + 0.5) - kWidth) / kHeight;
        const double y = (2.0 * (i / kWidth + 0.5) - kHeight) / kHeight;
        const glm::dvec3 across = slope * (x * right + y * up);
        const double perDepth = glm::length(forward + across);
        const glm::dvec3 direction = (forward + across) / perDepth;
        std::vector<render::RayBlob<double>> met;
        for (const TestBlob& blob : blobs) {
            const glm::dvec3 d = glm::dvec3(blob.center) - pose.position;
            const double along = glm::dot(d, direction), r = double(blob.radius), e = double(blob.emission);
            const double chord2 = r * r - (glm::dot(d, d) - along * along);
            const double middle = double(blob.crossSection) * 1.04445431404056 / (r * r * r);
            if (chord2 > 0.0)
                met.push_back({along, chord2, r, middle, {e, e, e}, uint32_t(met.size())});
        }
        render::ReferenceIntegral<double, decltype(exponential)> integral(
            met, {double(nearDistance) * perDepth, std::numeric_limits<double>::infinity(), {}}, 2, false,
            1e-6, root, exponential);
        lights.push_back(integral.light()[0]);
    }
    return lights;
}

} // namespace

TEST_F(VolumeNear, anEyeThatCrossesDenseBallsOfFewVoxelsSeesThemChangeAsTheyAre)
{
    constexpr int kFrames = 30;
    constexpr float kFovY = 0.9f, kNear = 0.01f, kFactor = 1.5f;
    view_->settings().voxels = 32;
    const std::vector<TestBlob> blobs = denseBalls();
    const base::FrameSnapshot snapshot = snapshotOf(blobs);
    double change = 0.0, exactChange = 0.0, worst = 0.0;
    std::vector<double> before, exactBefore, ratios;
    for (int frame = 0; frame < kFrames; ++frame) {
        const double x = 0.4 - 0.8 * frame / (kFrames - 1);
        const render::CameraPose pose{{x, 0.1, 0.05}, {x - 1.0, 0.2, 0.0}, {0.0f, 1.0f, 0.0f}};
        const Picture picture =
            drawn(snapshot, render::perspectiveView(pose, kFovY, float(kWidth) / kHeight, kNear));
        std::vector<double> now;
        for (size_t i = 0; i < picture.texels.size(); i += 4)
            now.push_back(double(picture.texels[i]));
        const std::vector<double> exact = exactLight(blobs, pose, kFovY, kNear);
        double moved = 0.0, exactMoved = 0.0;
        for (size_t i = 0; frame > 0 && i < now.size(); ++i) {
            moved += std::abs(now[i] - before[i]) / double(now.size());
            exactMoved += std::abs(exact[i] - exactBefore[i]) / double(now.size());
        }
        if (frame > 0)
            worst = std::max(worst, moved / exactMoved);
        change += moved;
        exactChange += exactMoved;
        before = now;
        exactBefore = exact;
    }
    EXPECT_GT(exactChange / (kFrames - 1), 2e-3) << "the picture does change";
    EXPECT_NEAR(change / exactChange, 1.0, 0.05);
    EXPECT_LT(worst, double(kFactor));
}

TEST_F(VolumeNear, aBallThatTheEyeNearsIsWholeWhateverShareOfItIsInVoxels)
{
    // 3 voxels of radius; the depth through its middle follows from the kernel alone: 35/(16 pi r^2) of the
    // cross section in its center, times 16/15 of the radius
    view_->settings().voxels = 48;
    const TestBlob ball{{0.0f, 0.0f, 0.0f}, 1.5f, 1.0f, 1.0f};
    const double wanted = 1.04445431404056 / (1.5 * 1.5) * 16.0 / 15.0;
    for (double away = 1.5; away < 3.2; away += 0.1) { // from the rim on
        const render::CameraPose pose{{0.0, 0.0, away}, {0.0, 0.0, 0.0}, {0.0f, 1.0f, 0.0f}};
        const Picture picture =
            drawn(snapshotOf({ball}), render::perspectiveView(pose, 0.01f, float(kWidth) / kHeight, 1e-3f));
        const double depth = -std::log(1.0 - double(picture.at(kWidth / 2, kHeight / 2)[3]));
        EXPECT_NEAR(depth / wanted, 1.0, 0.1) << away; // the center of a ball of three voxels
    }
}

TEST_F(VolumeNear, anEyeAtRestKeepsWhatIsNearItAndDrawnAgainItIsBitEqual)
{
    view_->settings().voxels = 32;
    const render::CameraPose pose{{0.1, 0.1, 0.05}, {-1.0, 0.2, 0.0}, {0.0f, 1.0f, 0.0f}};
    const render::CameraView camera = render::perspectiveView(pose, 0.9f, float(kWidth) / kHeight, 0.01f);
    const base::FrameSnapshot snapshot = snapshotOf(denseBalls());
    const Picture first = drawn(snapshot, camera);
    EXPECT_TRUE(executed("field near"));
    EXPECT_EQ(maxDifference(drawn(snapshot, camera), first), 0.0);
    for (const char* pass : {"field upload", "loose blob upload", "field fill", "field near"})
        EXPECT_FALSE(executed(pass)) << pass;
    EXPECT_EQ(maxDifference(drawn(snapshotOf(denseBalls()), camera), first), 0.0);
    EXPECT_TRUE(executed("field near"));
}

TEST_F(VolumeNear, detailedBallsOfFewVoxelsAreSeenAsInFineVoxels)
{
    // Near the eye no voxel is small enough for 2 to 4 of them a ball; of 192, none is near.
    constexpr int kFrames = 12;
    constexpr float kFovY = 0.9f, kNear = 0.01f;
    const std::vector<TestBlob> blobs = denseBalls();
    const base::FrameSnapshot snapshot = detailedSnapshotOf(blobs, 1.0f, 0.01f); // of one octave
    std::vector<Picture> fine, coarse;
    for (const int voxels : {192, 32}) {
        view_->settings().voxels = voxels;
        for (int frame = 0; frame < kFrames; ++frame) {
            const double x = 0.4 - 0.3 * frame / (kFrames - 1);
            const render::CameraPose pose{{x, 0.1, 0.05}, {x - 1.0, 0.2, 0.0}, {0.0f, 1.0f, 0.0f}};
            const auto camera = render::perspectiveView(pose, kFovY, float(kWidth) / kHeight, kNear);
            (voxels == 32 ? coarse : fine).push_back(drawn(snapshot, camera));
        }
        EXPECT_EQ(executed("field near"), voxels == 32);
    }
    const auto apart = [](const Picture& a, const Picture& b) {
        double sum = 0.0;
        for (size_t i = 0; i < a.texels.size(); i += 4)
            sum += std::abs(double(a.texels[i]) - double(b.texels[i]));
        return sum / double(a.texels.size() / 4);
    };
    double error = 0.0, change = 0.0, fineChange = 0.0;
    for (size_t k = 0; k < fine.size(); ++k) {
        error += apart(coarse[k], fine[k]) / double(kFrames);
        change += k > 0 ? apart(coarse[k], coarse[k - 1]) : 0.0;
        fineChange += k > 0 ? apart(fine[k], fine[k - 1]) : 0.0;
    }
    std::printf("mean difference %.4f, change from frame to frame %.4f of %.4f\n", error,
                change / (kFrames - 1), fineChange / (kFrames - 1));
    EXPECT_GT(fineChange / (kFrames - 1), 2e-3) << "the picture does change";
    EXPECT_LT(error, 0.003);
    EXPECT_NEAR(change / fineChange, 1.0, 0.05);
}

TEST_F(VolumeNear, layersAddUpToThePictureWithoutLayers)
{
    view_->settings().voxels = 32;
    const render::CameraPose pose{{0.9, 0.1, 0.05}, {-1.0, 0.2, 0.0}, {0.0f, 1.0f, 0.0f}};
    const render::CameraView camera = render::perspectiveView(pose, 0.9f, float(kWidth) / kHeight, 0.01f);
    std::vector<TestBlob> blobs = denseBalls();
    for (size_t i = 0; i < blobs.size(); ++i) {
        blobs[i].crossSection *= 0.02f;
        blobs[i].fireShare = i % 3 == 0 ? 0.5f : 0.0f;
        blobs[i].layer = i % 2 == 0 ? base::MediaLayer::Smoke : base::MediaLayer::Dust;
    }
    const base::FrameSnapshot snapshot = snapshotOf(blobs);
    const Picture plain = drawn(snapshot, camera);
    view_->settings().layerOutputs = true;
    (void)drawn(snapshot, camera);
    EXPECT_TRUE(executed("field near"));
    const render::LayerTextures all = view_->layers();
    const Picture fire = read(all.fire), smoke = read(all.smoke), dust = read(all.dust);
    double worst = 0.0, least[3] = {1.0, 1.0, 1.0};
    for (size_t i = 3; i < plain.texels.size(); i += 4) { // opacities
        const double kept[] = {1.0 - double(fire.texels[i]), 1.0 - double(smoke.texels[i]),
                               1.0 - double(dust.texels[i])};
        for (int layer = 0; layer < 3; ++layer)
            least[layer] = std::min(least[layer], kept[layer]);
        worst = std::max(worst, std::abs(double(fire.texels[i] + smoke.texels[i] + dust.texels[i]) -
                                         double(plain.texels[i])));
    }
    for (const double kept : least)
        EXPECT_LT(kept, 0.9) << "each layer is seen";
    EXPECT_LT(worst, 0.03);
}
