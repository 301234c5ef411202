// Far effects as pictures of themselves: that they look like the effects, when they are taken anew, and that
// nothing jumps.
#include "view_fixture.h"

#include <algorithm>
#include <cmath>
#include <random>

using namespace fx;
using test::Picture;
using test::TestBlob;

namespace {

constexpr int kSize = 96;
constexpr float kHalfView = 0.3f; ///< [rad]

class Impostors : public test::ViewTest
{
protected:
    void SetUp() override
    {
        ViewTest::SetUp();
        makeTargets(kSize, kSize);
        view_->settings().lighting.sunIlluminance = glm::vec3(1.0f);
        view_->settings().lighting.skyLuminance = glm::vec3(0.3f);
        request_.camera = cameraAt({0, 0, 0});
    }

    static render::CameraView cameraAt(const glm::dvec3& eye)
    {
        return render::perspectiveView({eye, eye + glm::dvec3(0, 0, -1)}, 2.0f * kHalfView, 1.0f, 0.1f);
    }

    /// A cloud of radius 2 m with its bounds, centered at `place`.
    base::FrameSnapshot cloud(const glm::dvec3& place, unsigned seed = 1, float emission = 1.0f)
    {
        std::mt19937 random(seed);
        const auto uniform = [&] { return float(random() % 20001) * 1e-4f - 1.0f; };
        std::vector<TestBlob> blobs;
        for (int i = 0; i < 60; ++i) {
            TestBlob blob{{uniform(), uniform(), uniform()}, 0.8f, 0.15f, emission};
            blob.albedo = 0.5f;
            blobs.push_back(blob);
        }
        base::FrameSnapshot snapshot = snapshotOf(blobs, place);
        for (size_t g = 0; g < snapshot.groupCount(); ++g) {
            base::GroupInfo& info = const_cast<base::SnapshotGroup&>(snapshot.group(g)).editInfo();
            info.instance = 5;
            info.bounds.min = glm::vec3(-2.0f);
            info.bounds.max = glm::vec3(2.0f);
        }
        return snapshot;
    }

    Picture show(const base::FrameSnapshot& snapshot, int frames = 1)
    {
        request_.targets.color = color_->name();
        request_.targets.depth = useDepth_ ? depth_->name() : 0;
        request_.targets.width = request_.targets.height = kSize;
        request_.deltaTime = 1.0 / 60.0;
        base::SnapshotPair pair;
        pair.newer = &snapshot;
        for (int i = 0; i < frames; ++i) {
            setPicture(std::vector<float>(kSize * kSize * 4, 0.0f));
            const base::Status status = view_->render(pair, request_);
            EXPECT_TRUE(status.ok()) << status.message();
            taken_ += view_->statistics().impostorsTaken;
        }
        return read(color_->name());
    }

    static double sum(const Picture& picture)
    {
        double light = 0.0;
        for (size_t i = 0; i < picture.texels.size(); i += 4)
            light += double(picture.texels[i]);
        return light;
    }
    static double brightest(const Picture& picture)
    {
        double most = 0.0;
        for (size_t i = 0; i < picture.texels.size(); i += 4)
            most = std::max(most, double(picture.texels[i]));
        return most;
    }
    static double meanDifference(const Picture& a, const Picture& b)
    {
        double difference = 0.0;
        for (size_t i = 0; i < a.texels.size(); i += 4)
            difference += std::abs(double(a.texels[i]) - double(b.texels[i]));
        return difference / sum(b);
    }

    /// [m] at which a ball of 2 sqrt(3) m has a radius of `pixels`.
    static double distanceOf(double pixels)
    {
        return 2.0 * std::sqrt(3.0) * 0.5 * kSize / std::tan(double(kHalfView)) / pixels;
    }

    render::FrameRequest request_;
    uint64_t taken_ = 0;
};

} // namespace

TEST_F(Impostors, lookLikeTheEffectTheyStandFor)
{
    for (const glm::dvec2 aside : {glm::dvec2(0, 0), glm::dvec2(0.18, -0.2), glm::dvec2(-0.2, 0.1)}) {
        const double distance = distanceOf(8.0);
        const auto snapshot = cloud({aside.x * distance, aside.y * distance, -distance});
        view_->settings().lod.impostorPixels = 0.0f;
        const Picture blobs = show(snapshot);
        EXPECT_EQ(view_->statistics().impostors, 0u);
        view_->settings().lod.impostorPixels = 13.0f;
        const Picture picture = show(snapshot, 40);
        EXPECT_EQ(view_->statistics().impostors, 1u);
        EXPECT_EQ(view_->statistics().blobs, 0u) << "the picture alone is drawn";
        EXPECT_NEAR(sum(picture) / sum(blobs), 1.0, 0.05);
        EXPECT_LT(meanDifference(picture, blobs), 0.15);
        EXPECT_LT(test::maxDifference(picture, blobs), 0.25 * brightest(blobs));
    }
}

TEST_F(Impostors, ofLargeEffectsDoNotExist)
{
    view_->settings().lod.impostorPixels = 10.0f;
    const auto near = cloud({0, 0, -distanceOf(14.0)});
    (void)show(near, 20);
    EXPECT_EQ(view_->statistics().impostors, 0u);
    EXPECT_EQ(taken_, 0u);
}

TEST_F(Impostors, areTakenOnceWhileNothingChanges)
{
    view_->settings().lod.impostorPixels = 13.0f;
    const auto snapshot = cloud({0, 0, -distanceOf(8.0)});
    (void)show(snapshot, 60);
    EXPECT_EQ(taken_, 1u);
    EXPECT_TRUE(view_->statistics().keptLists);
    EXPECT_EQ(view_->statistics().uploadedBytes, 0u);
}

TEST_F(Impostors, areTakenAnewWhenStateViewOrLightHasChanged)
{
    view_->settings().lod.impostorPixels = 13.0f;
    const double distance = distanceOf(8.0);
    const auto snapshot = cloud({0, 0, -distance});
    (void)show(snapshot, 40);
    ASSERT_EQ(taken_, 1u);
    request_.camera = cameraAt({0.05 * distance, 0, 0}); // 0.4 pixels of parallax at the rim
    (void)show(snapshot, 20);
    EXPECT_EQ(taken_, 1u) << "less than the bound";
    request_.camera = cameraAt({0.2 * distance, 0, 0});
    (void)show(snapshot, 20);
    EXPECT_EQ(taken_, 2u) << "seen from elsewhere";
    view_->settings().lighting.sunDirection = {0, 1, 0};
    (void)show(snapshot, 20);
    EXPECT_EQ(taken_, 3u) << "other light";
    const auto other = cloud({0, 0, -distance}, 2);
    (void)show(other, 20);
    EXPECT_EQ(taken_, 4u) << "other state";
    render::HostLights& host = view_->settings().hostLights;
    host.lights[host.count++] = {{0, 5, -distance}, glm::vec3(10.0f)};
    (void)show(other, 20);
    EXPECT_EQ(taken_, 5u) << "a lamp of the host";
    view_->settings().slices.multiple = false;
    (void)show(other, 20);
    EXPECT_EQ(taken_, 6u) << "scattered once";
}

TEST_F(Impostors, fadeFromStateToStateWithoutAJump)
{
    view_->settings().lod.impostorPixels = 13.0f;
    const auto dark = cloud({0, 0, -distanceOf(8.0)}, 1, 1.0f);
    const auto bright = cloud({0, 0, -distanceOf(8.0)}, 1, 3.0f);
    const Picture first = show(dark, 40);
    Picture before = first;
    double largest = 0.0;
    for (int i = 0; i < 12; ++i) {
        const Picture now = show(bright);
        largest = std::max(largest, test::maxDifference(now, before));
        before = now;
    }
    const double whole = test::maxDifference(before, first);
    EXPECT_GT(whole, 0.1 * brightest(first));
    EXPECT_LT(largest, 0.3 * whole) << "a sixth a frame, a tenth of a second for all";
}

TEST_F(Impostors, replaceTheirBlobsWithoutLosingOpacityOnTheWay)
{
    view_->settings().lod.impostorPixels = 0.0f;
    const auto snapshot = cloud({0, 0, -distanceOf(8.0)});
    const Picture blobs = show(snapshot);
    view_->settings().lod.impostorPixels = 13.0f;
    for (int i = 0; i < 25; ++i)
        EXPECT_NEAR(sum(show(snapshot)) / sum(blobs), 1.0, 0.06) << i;
}

TEST_F(Impostors, areHiddenByWhatStandsBeforeThem)
{
    view_->settings().lod.impostorPixels = 13.0f;
    const auto snapshot = cloud({0, 0, -distanceOf(8.0)});
    EXPECT_GT(sum(show(snapshot, 40)), 0.0);
    setDepth(std::vector<float>(kSize * kSize, 0.0f)); // a wall at the near plane
    EXPECT_NEAR(sum(show(snapshot, 1)), 0.0, 1e-4);
}

TEST_F(Impostors, thePictureBeforeKeepsItsSizeWhenAnotherIsTakenFromNearer)
{
    view_->settings().lod.impostorPixels = 13.0f;
    const auto snapshot = cloud({0, 0, -distanceOf(6.0)});
    const Picture far = show(snapshot, 40);
    ASSERT_EQ(taken_, 1u);
    request_.camera = cameraAt({0, 0, -0.3 * distanceOf(6.0)});
    view_->settings().lod.hold = true;
    const Picture held = show(snapshot);
    ASSERT_EQ(taken_, 1u);
    view_->settings().lod.hold = false;
    const Picture first = show(snapshot);
    ASSERT_EQ(taken_, 2u) << "1.4 times as large";
    EXPECT_LT(test::maxDifference(first, held), 0.02 * brightest(held)) << "it begins as the older one";
    EXPECT_GT(test::maxDifference(first, far), 0.1 * brightest(held));
    EXPECT_GT(test::maxDifference(show(snapshot, 20), held), 0.02 * brightest(held))
        << "and becomes the newer";
}
