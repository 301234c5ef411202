// Light slices in a view: what is shaded, and what a frame does for it.
#include "tests/rendering/gl/heap_counter.h"
#include "view_fixture.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

using namespace fx;
using namespace fx::test;

namespace {

constexpr int kSide = 64;

class LightSlicesView : public ViewTest
{
protected:
    void SetUp() override
    {
        ViewTest::SetUp();
        makeTargets(kSide, kSide);
        render::Lighting& lighting = view_->settings().lighting;
        lighting.sunDirection = {1, 0, 0};
        lighting.sunIlluminance = glm::vec3(10.0f);
        lighting.groundAlbedo = 0.0f;
        view_->settings().slices.multiple = false;
        view_->settings().slices.resolution = {64, 32};
    }

    Picture draw(const base::FrameSnapshot& snapshot, const glm::dvec3& eye = {0, 0, 12})
    {
        setPicture(std::vector<float>(size_t(kSide) * kSide * 4, 0.0f));
        return render(snapshot, render::perspectiveView({eye, {eye.x, 0, 0}}, 1.0f, 1.0f, 0.1f));
    }

    bool has(const char* what) const
    {
        return std::ranges::any_of(view_->executedPasses(),
                                   [&](std::string_view name) { return name == what; });
    }

    void addPoint(const glm::dvec3& position, float intensity)
    {
        render::HostLights& lights = view_->settings().hostLights;
        lights.lights[lights.count].position = position;
        lights.lights[lights.count].intensity = glm::vec3(intensity);
        lights.lights[lights.count++].radius = 0.1f;
    }

    /// Sum of what is seen of x from `low` to `high` [m], on the plane through the middle.
    static double light(const Picture& picture, double low, double high)
    {
        const auto column = [](double x) { // 12 m away, 1 radian across
            return int((x / (2.0 * 12.0 * std::tan(0.5)) + 0.5) * kSide);
        };
        double sum = 0.0;
        for (int y = 0; y < kSide; ++y)
            for (int x = std::max(column(low), 0); x < std::min(column(high), kSide); ++x)
                sum += double(picture.at(x, y)[0]);
        return sum;
    }

    static TestBlob smoke(const glm::vec3& center, float radius = 1.0f, float crossSection = 6.0f)
    {
        TestBlob blob;
        blob.center = center;
        blob.radius = radius;
        blob.crossSection = crossSection;
        blob.albedo = 0.9f;
        return blob;
    }
};

const char* const kPasses[] = {"light list", "light slice casters", "light slices", "blob light"};

} // namespace

TEST_F(LightSlicesView, aBallIsDarkOnItsFarSide)
{
    const auto ball = snapshotOf({smoke({0, 0, 0}, 2.0f, 25.0f)});
    const Picture picture = draw(ball);
    const double near = light(picture, 0.0, 2.0), far = light(picture, -2.0, 0.0);
    EXPECT_GT(near, 3.0 * far);
    EXPECT_GT(far, 0.0);
    view_->settings().slices.enabled = false;
    const Picture flat = draw(ball);
    EXPECT_NEAR(light(flat, 0.0, 2.0) / light(flat, -2.0, 0.0), 1.0, 0.1) << "the control";
}

TEST_F(LightSlicesView, twoEffectsShadeEachOther)
{
    const auto behind = [&](bool isShaded) {
        auto snapshot = snapshotOf({smoke({-2.5f, 0, 0})});
        if (isShaded) { // another group
            TestBlob other = smoke({0.0f, 0, 0}, 1.5f, 12.0f);
            other.layer = base::MediaLayer::Dust;
            snapshot = snapshotOf({smoke({-2.5f, 0, 0}), other});
        }
        return light(draw(snapshot), -3.5, -1.6);
    };
    const double alone = behind(false), shaded = behind(true);
    // depth through the middle of the other: 3.5 / pi * 12 / 1.5^2 = 5.9; about its rim less
    EXPECT_LT(shaded, 0.25 * alone);
    view_->settings().slices.enabled = false;
    EXPECT_NEAR(behind(true) / behind(false), 1.0, 1e-3) << "the control";
}

TEST_F(LightSlicesView, alsoPointsAreShadedAndALightWithinABallShines)
{
    view_->settings().lighting.sunIlluminance = glm::vec3(0.0f);
    addPoint({3.5, 0.0, 0.0}, 200.0f);
    const auto two = snapshotOf({smoke({1.0f, 0, 0}, 1.2f, 12.0f), smoke({-2.0f, 0, 0})});
    const double shaded = light(draw(two), -3.0, -1.0);
    const double alone = light(draw(snapshotOf({smoke({-2.0f, 0, 0})})), -3.0, -1.0);
    EXPECT_LT(shaded, 0.2 * alone);
    view_->settings().hostLights.lights[0].position = {0, 0, 0};
    const double within = light(draw(snapshotOf({smoke({0, 0, 0}, 1.5f, 4.0f)})), -1.5, 1.5);
    EXPECT_GT(within, 0.0);
    view_->settings().hostLights.lights[0].position = {0, 0, -20}; // as far behind as the eye is before it
    EXPECT_GT(within, 20.0 * light(draw(snapshotOf({smoke({0, 0, 0}, 1.5f, 4.0f)})), -1.5, 1.5));
}

TEST_F(LightSlicesView, whatRestsIsNotDoneAgain)
{
    view_->settings().lighting.skyLuminance = glm::vec3(1.0f);
    addPoint({3.5, 0.0, 0.0}, 20.0f);
    const auto snapshot = snapshotOf({smoke({0, 0, 0}), smoke({1, 1, 0})});
    const Picture first = draw(snapshot);
    for (const char* pass : kPasses)
        EXPECT_TRUE(has(pass)) << pass;
    for (int frame = 0; frame < 4; ++frame) {
        EXPECT_EQ(maxDifference(draw(snapshot), first), 0.0);
        for (const char* pass : kPasses)
            EXPECT_FALSE(has(pass)) << pass << " in frame " << frame;
    }
}

TEST_F(LightSlicesView, planesAreFilledAnewOnlyWhereLightOrMediaChange)
{
    view_->settings().lighting.skyLuminance = glm::vec3(1.0f);
    addPoint({3.5, 0.0, 0.0}, 20.0f);
    const auto snapshot = snapshotOf({smoke({0, 0, 0}), smoke({1, 1, 0})});
    (void)draw(snapshot);
    for (int frame = 1; frame < 4; ++frame) {
        (void)draw(snapshot, {0.1 * frame, 0.3 * frame, 12.7});
        EXPECT_FALSE(has("light slices")) << "only the eye moves";
    }
    view_->settings().hostLights.lights[0].intensity *= 0.5f;
    (void)draw(snapshot, {1.5, 0, 12});
    EXPECT_FALSE(has("light slices")) << "only a light flickers";
    view_->settings().lighting.sunDirection = glm::normalize(glm::vec3(1.0f, 0.1f, 0.0f));
    (void)draw(snapshot, {1.5, 0, 12});
    EXPECT_TRUE(has("light slices")) << "the sun moves";
    (void)draw(snapshotOf({smoke({0, 0, 0}), smoke({1, 1.5f, 0})}), {1.5, 0, 12});
    EXPECT_TRUE(has("light slices")) << "media move";
}

TEST_F(LightSlicesView, thePictureDependsOnWhereTheEyeWasOnlyByRounding)
{
    const auto snapshot = snapshotOf({smoke({0, 0, 0}, 2.0f, 10.0f), smoke({1, 1, 0})});
    const Picture first = draw(snapshot);
    for (int i = 1; i < 50; ++i)
        (void)draw(snapshot, {0.01 * i * i, 0, 12.0 + i});
    EXPECT_LT(maxDifference(draw(snapshot), first), 1e-5);
}

TEST_F(LightSlicesView, withoutSlicesThereIsNoPassAndNoProgramForThem)
{
    view_->settings().lighting.skyLuminance = glm::vec3(1.0f);
    view_->settings().slices.enabled = false;
    const auto snapshot = snapshotOf({smoke({0, 0, 0})});
    (void)draw(snapshot);
    const uint32_t programs = view_->statistics().programsCompiled;
    for (const char* pass : {"light slice casters", "light slices"})
        EXPECT_FALSE(has(pass)) << pass;
    view_->settings().slices.enabled = true;
    (void)draw(snapshot);
    EXPECT_EQ(view_->statistics().programsCompiled, 1u) << "the planes";
    EXPECT_GT(programs, 0u);
}

TEST_F(LightSlicesView, noMediaNoPlanes)
{
    addPoint({3.5, 0.0, 0.0}, 20.0f);
    (void)draw(snapshotOf({}));
    EXPECT_TRUE(view_->executedPasses().empty());
}

TEST_F(LightSlicesView, aWarmFrameAllocatesNothing)
{
    view_->settings().lighting.skyLuminance = glm::vec3(1.0f);
    addPoint({3.5, 0.0, 0.0}, 20.0f);
    ASSERT_TRUE(view_->warmUp().ok());
    const base::FrameSnapshot snapshots[] = {snapshotOf({smoke({0, 0, 0}), smoke({1, 1, 0})}),
                                             snapshotOf({smoke({0, 0.1f, 0}), smoke({1, 1, 0})}),
                                             snapshotOf({smoke({0, 0.2f, 0}), smoke({1, 1, 0.1f})})};
    render::FrameRequest request;
    request.targets.color = color_->name();
    request.targets.width = request.targets.height = kSide;
    request.camera = render::perspectiveView({{0, 0, 12}, {0, 0, 0}}, 1.0f, 1.0f, 0.1f);
    for (int frame = 0; frame < 15; ++frame) {
        view_->settings().lighting.sunDirection =
            glm::normalize(glm::vec3(1.0f, 0.1f * float(frame % 4), 0.0f));
        view_->settings().hostLights.lights[0].position.y = 0.1 * (frame % 5);
        const base::SnapshotPair pair{&snapshots[frame % 3], nullptr};
        render::HeapCounter counter;
        const bool good = view_->render(pair, request).ok();
        const int taken = counter.stop();
        ASSERT_TRUE(good);
        EXPECT_TRUE(has("light slices"));
        if (frame >= 9) {
            EXPECT_EQ(taken, 0) << "frame " << frame;
            EXPECT_EQ(view_->statistics().programsCompiled, 0u);
        }
    }
}

TEST_F(LightSlicesView, lightsOfAnyStrengthAndPlaceGiveNumbers)
{
    const auto snapshot = snapshotOf({smoke({0, 0, 0}), smoke({1, 1, 0})});
    for (const float intensity : {0.0f, 1e-30f, 1e30f, std::numeric_limits<float>::quiet_NaN()})
        for (const glm::dvec3& place : {glm::dvec3(0.0), {0, 0, 12}, {0, 0, 20}, {1e7, 0, 0}}) {
            view_->settings().hostLights.count = 0;
            addPoint(place, intensity);
            const Picture picture = draw(snapshot);
            EXPECT_TRUE(std::ranges::all_of(picture.texels, [](float x) { return std::isfinite(x); }))
                << intensity << " at " << place.x << " " << place.z;
        }
}

TEST_F(LightSlicesView, planesFollowMovingMediaAfterAsManyFramesAsAsked)
{
    const auto moved = [&](int frame) {
        return snapshotOf({smoke({0.02f * float(frame), 0, 0}), smoke({2.0f, 0.1f * float(frame), 0})});
    };
    const auto eyeOf = [](int frame) { return glm::dvec3(0.01 * frame, 0, 12); };
    view_->settings().slices.refreshFrames = 3;
    for (int frame = 0; frame < 7; ++frame) {
        draw(moved(frame), eyeOf(frame));
        EXPECT_EQ(has("light slices"), frame % 3 == 0) << frame;
    }
    const auto last = moved(20);
    const Picture behind = draw(last, eyeOf(20));
    EXPECT_FALSE(has("light slices"));
    const Picture atRest = draw(last, eyeOf(20));
    EXPECT_TRUE(has("light slices"));
    view_->settings().slices.refreshFrames = 1;
    draw(moved(0), eyeOf(20));
    const Picture wanted = draw(last, eyeOf(20));
    EXPECT_EQ(maxDifference(atRest, wanted), 0.0);
    EXPECT_GT(maxDifference(behind, wanted), 1e-3);
}

TEST_F(LightSlicesView, planesOfMediaThatWaitLieWhereTheyWere)
{
    const auto cloud = snapshotOf({smoke({0, 0, 0}), smoke({2.0f, 0, 0})});
    const auto other = snapshotOf({smoke({0, 0, 0}), smoke({2.0f, 1e-6f, 0})});
    view_->settings().slices.refreshFrames = 16;
    draw(cloud);
    for (int frame = 1; frame < 9; ++frame) { // the eye goes on and the light stays
        const glm::dvec3 eye(0.3 * frame, 0.0, 12.0 - 0.1 * frame);
        const Picture held = draw(frame % 2 ? other : cloud, eye);
        ASSERT_FALSE(has("light slices"));
        view_->settings().slices.refreshFrames = 1;
        const Picture wanted = draw(frame % 2 ? other : cloud, eye);
        view_->settings().slices.refreshFrames = 16;
        EXPECT_LE(maxDifference(held, wanted), 2e-3) << frame;
        draw(cloud, eye);
    }
}
