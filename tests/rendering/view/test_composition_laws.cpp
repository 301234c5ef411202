// What holds in every composition of overlapping media, whatever it makes of them: light is conserved, a ray
// may be cut anywhere, and hard cases stay within what physics allows.
#include "particle_fixture.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <string>

using namespace fx;
using namespace fx::test;
namespace constant = base::particle_constant;

namespace {

using render::Composition;

constexpr int kSide = 32;
constexpr float kPi = 3.14159265f;
const render::CameraPose kPose{{0.0, 0.0, 6.0}, {0.0, 0.0, 0.0}, {0.0f, 1.0f, 0.0f}};

/// Cross section of a ball whose middle has this optical depth.
float crossSectionOf(float opticalDepth, float radius)
{
    return opticalDepth * kPi * radius * radius / 3.5f;
}

/// Balls about a ball of radius 1 that all emit `emission`.
std::vector<TestBlob> cloud(size_t count, float radius, float opticalDepth, float emission = 0.7f)
{
    std::mt19937 random(11);
    std::uniform_real_distribution<float> side(-0.7f, 0.7f);
    std::vector<TestBlob> blobs(count);
    for (TestBlob& blob : blobs) {
        const float x = side(random), y = side(random), z = side(random);
        blob.center = {x, y, z};
        blob.radius = radius;
        blob.crossSection = crossSectionOf(opticalDepth, radius);
        blob.emission = emission;
    }
    return blobs;
}

class CompositionLaws : public ParticleTest, public testing::WithParamInterface<Composition>
{
protected:
    void SetUp() override
    {
        ParticleTest::SetUp();
        makeTargets(kSide, kSide);
        view_->settings().composition = GetParam();
        view_->settings().voxels = 96;
    }
    Picture drawn(const base::FrameSnapshot& snapshot, const render::CameraView& camera)
    {
        setPicture(std::vector<float>(size_t(kSide) * kSide * 4, 0.0f));
        return renderPair(snapshot, nullptr, 1.0, camera);
    }
    Picture drawn(const std::vector<TestBlob>& blobs, const render::CameraView& camera)
    {
        return drawn(snapshotOf(blobs), camera);
    }
    render::CameraView camera(float nearDistance = 0.1f) const
    {
        return render::perspectiveView(kPose, 0.6f, 1.0f, nearDistance);
    }
    bool isVolume() const { return GetParam() == Composition::Volume; }

    /// No texel is brighter than its share of the brightest source, and all are numbers.
    void expectBounded(const Picture& picture, float brightest, const std::string& what)
    {
        for (size_t i = 0; i < picture.texels.size(); i += 4) {
            const float alpha = picture.texels[i + 3];
            ASSERT_TRUE(std::isfinite(alpha) && alpha >= 0.0f && alpha <= 1.0f + 1e-6f)
                << what << ": opacity " << alpha;
            for (size_t c = 0; c < 3; ++c) {
                const float light = picture.texels[i + c];
                ASSERT_TRUE(std::isfinite(light) && light >= 0.0f) << what << ": light " << light;
                ASSERT_LE(light, brightest * alpha * 1.002f + 1e-5f * brightest)
                    << what << ": opacity " << alpha;
            }
        }
    }
    static float alphaAt(const Picture& picture) { return picture.at(kSide / 2, kSide / 2)[3]; }
};

} // namespace

TEST_P(CompositionLaws, aFurnaceOfBallsAndSpritesIsAsBrightAsTheyAre)
{
    auto snapshot = snapshotOf(cloud(120, 0.5f, 0.4f));
    std::vector<TestParticle> sprites;
    for (int i = 0; i < 12; ++i)
        sprites.push_back({{0.1f * float(i % 3), 0.1f * float(i % 4), 0.25f * float(i) - 1.5f},
                           0.8f,
                           glm::vec4(0.7f, 0.7f, 0.7f, 0.3f)});
    addParticles(snapshot, sprites);
    const Picture picture = drawn(snapshot, camera());
    float thickest = 0.0f;
    for (size_t i = 0; i < picture.texels.size(); i += 4) {
        const float alpha = picture.texels[i + 3];
        thickest = std::max(thickest, alpha);
        ASSERT_NEAR(picture.texels[i], 0.7f * alpha, isVolume() ? 1e-3f : 2e-4f);
    }
    EXPECT_GT(thickest, 0.999f);
}

TEST_P(CompositionLaws, aPlaneOfDepthSplitsTheTransmittanceIntoAProduct)
{
    auto snapshot = snapshotOf(cloud(60, 0.5f, 0.15f));
    addParticles(snapshot, {{{0.0f, 0.0f, 0.9f}, 0.6f, glm::vec4(0.5f, 0.5f, 0.5f, 0.4f)},
                            {{0.1f, 0.0f, -0.9f}, 0.6f, glm::vec4(0.5f, 0.5f, 0.5f, 0.3f)}});
    const auto passed = [&](float nearDistance, float farStored) {
        setDepth(std::vector<float>(size_t(kSide) * kSide, farStored));
        return drawn(snapshot, render::orthographicView(kPose, 2.5f, 1.0f, nearDistance, 20.0f));
    };
    const Picture whole = passed(0.5f, 1.0f);
    EXPECT_GT(alphaAt(whole), 0.5f);
    for (const float middle : {5.6f, 6.0f, 6.3f}) {
        const Picture before = passed(0.5f, (middle - 0.5f) / 19.5f);
        const Picture behind = passed(middle, 1.0f);
        for (size_t i = 3; i < whole.texels.size(); i += 4) {
            const float product = (1.0f - before.texels[i]) * (1.0f - behind.texels[i]);
            ASSERT_NEAR(1.0f - whole.texels[i], product, isVolume() ? 4e-3f : 2e-4f) << middle;
        }
    }
}

TEST_P(CompositionLaws, coincidentBallsAreOneOfTheirSum)
{
    const float depth = 1.5f;
    TestBlob ball = cloud(1, 0.9f, depth)[0];
    ball.center = glm::vec3(0.0f);
    const Picture one = drawn(std::vector<TestBlob>{ball}, camera());
    ball.crossSection /= 512.0f;
    const std::vector<TestBlob> many(512, ball);
    const Picture all = drawn(many, camera());
    EXPECT_GT(alphaAt(one), 0.3f);
    // fields keep extinction as a half, and sums of halves round each
    EXPECT_LT(maxDifference(one, all), isVolume() ? 2e-3 : 1e-3);
    expectBounded(all, 0.7f, "512 coincident balls");
}

TEST_P(CompositionLaws, mediaOfAnyDepthAreAsBrightAsTheirSource)
{
    for (const float depth : {1e-6f, 1.0f, 1e3f, 1e4f}) {
        const Picture picture = drawn(cloud(1000, 0.3f, depth), camera());
        expectBounded(picture, 0.7f, "1000 balls of depth " + std::to_string(depth));
        if (depth >= 1.0f)
            // slabs do not see the light behind a depth of 9, which they find too soon in the densest media
            EXPECT_NEAR(picture.at(kSide / 2, kSide / 2)[0], 0.7f, depth > 1.0f ? 1.5e-2f : 1e-3f) << depth;
        else
            EXPECT_LT(alphaAt(picture), 1000.0f * depth) << depth;
    }
}

TEST_P(CompositionLaws, theEyeMayBeInAllBallsAtOnce)
{
    std::vector<TestBlob> around = cloud(300, 1.5f, 0.02f);
    for (TestBlob& blob : around)
        blob.center += glm::vec3(0.0f, 0.0f, 6.0f);
    for (const float nearDistance : {1e-3f, 0.1f, 1.0f}) {
        const Picture picture = drawn(around, camera(nearDistance));
        expectBounded(picture, 0.7f, "the eye in 300 balls");
        EXPECT_GT(alphaAt(picture), 0.1f);
    }
}

TEST_P(CompositionLaws, ballsOfAnySizeStandBesideEachOther)
{
    for (const float radius : {1e-3f, 1e-2f, 10.0f, 1e3f}) {
        std::vector<TestBlob> blobs = cloud(50, 0.4f, 0.2f);
        TestBlob other = blobs[0];
        other.center = {0.0f, 0.0f, 0.3f};
        other.radius = radius;
        other.crossSection = crossSectionOf(0.5f, radius);
        blobs.push_back(other);
        const Picture picture = drawn(blobs, camera());
        expectBounded(picture, 0.7f, "a ball of radius " + std::to_string(radius));
        EXPECT_GT(alphaAt(picture), 0.3f);
    }
}

TEST_P(CompositionLaws, anyRangeOfDepthIsLegal)
{
    const std::vector<TestBlob> blobs = cloud(100, 0.5f, 0.1f);
    const Picture usual = drawn(blobs, camera());
    for (const float nearDistance : {1e-6f, 1e-3f, 1.0f})
        EXPECT_LT(maxDifference(drawn(blobs, camera(nearDistance)), usual), 1e-4) << nearDistance;
    setDepth(std::vector<float>(size_t(kSide) * kSide, 0.0f)); // a surface at the near plane
    const Picture nothing = drawn(blobs, camera());
    EXPECT_EQ(*std::max_element(nothing.texels.begin(), nothing.texels.end()), 0.0f);
}

TEST_P(CompositionLaws, millionsOfMetersFromTheOriginThePictureIsTheSame)
{
    const std::vector<TestBlob> blobs = cloud(100, 0.5f, 0.1f);
    const Picture here = drawn(blobs, camera());
    for (const glm::dvec3 far : {glm::dvec3(1e5, 0.0, -1e5), glm::dvec3(3e6, 1e6, -2e6), glm::dvec3(1e7)}) {
        const render::CameraPose pose{kPose.position + far, kPose.target + far, kPose.up};
        const Picture there = drawn(snapshotOf(blobs, far), render::perspectiveView(pose, 0.6f, 1.0f, 0.1f));
        expectBounded(there, 0.7f, "far away");
        // voxels lie elsewhere in the effect there
        EXPECT_LT(maxDifference(there, here), isVolume() ? 2e-2 : 2e-5) << far.x;
    }
}

TEST_P(CompositionLaws, numbersAtTheEdgeOfTheirRangeAreHarmless)
{
    const float huge = std::numeric_limits<float>::max(), inf = std::numeric_limits<float>::infinity();
    const float nan = std::numeric_limits<float>::quiet_NaN();
    std::vector<TestBlob> blobs = cloud(30, 0.5f, 0.2f);
    const Picture clean = drawn(blobs, camera());
    for (const float broken : {inf, -inf, nan, huge}) {
        TestBlob blob = blobs[0];
        blob.center.x = broken;
        blobs.push_back(blob);
    }
    for (const float radius : {0.0f, -1.0f, inf, nan}) {
        TestBlob blob = blobs[0];
        blob.radius = radius;
        blobs.push_back(blob);
    }
    for (const float crossSection : {0.0f, -1.0f, inf, nan}) {
        TestBlob blob = blobs[0];
        blob.crossSection = crossSection;
        blobs.push_back(blob);
    }
    const Picture picture = drawn(blobs, camera());
    expectBounded(picture, 0.7f, "broken balls");
    EXPECT_LT(maxDifference(picture, clean), isVolume() ? 1e-2 : 1e-3);
}

INSTANTIATE_TEST_SUITE_P(Compositions, CompositionLaws,
                         testing::Values(Composition::Sorted, Composition::Slabs, Composition::Volume),
                         [](const auto& one) {
                             return one.param == Composition::Sorted  ? "Sorted"
                                    : one.param == Composition::Slabs ? "Slabs"
                                                                      : "Volume";
                         });
