// What must not change a picture, and what must add up.
#include "foundation/random/philox.h"
#include "rendering/frame/exposure.h"
#include "rendering/frame/view_block.h"
#include "view_fixture.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

using namespace fx;
using namespace fx::test;

namespace {

constexpr int kSize = 128; // square, so that a quarter turn of the camera maps pixels to pixels

std::vector<TestBlob> cloud(int count)
{
    std::vector<TestBlob> blobs;
    for (int i = 0; i < count; ++i) {
        const auto u = base::randomUnit4(11, 0, uint64_t(i), base::RandomPurpose::Position);
        const auto v = base::randomUnit4(11, 1, uint64_t(i), base::RandomPurpose::Attributes);
        TestBlob blob;
        blob.center = glm::vec3(u[0], u[1], u[2]) * 4.0f - 2.0f;
        blob.radius = 0.3f + 0.7f * u[3];
        blob.crossSection = 0.2f + v[0];
        blob.layer = base::MediaLayer(i % 3);
        blob.emission = blob.layer == base::MediaLayer::Dust ? 0.0f : v[1];
        blob.albedo = blob.layer == base::MediaLayer::Fire ? 0.0f : 0.6f;
        blob.fireShare = blob.layer == base::MediaLayer::Smoke ? 0.4f : 0.0f;
        blobs.push_back(blob);
    }
    return blobs;
}

render::CameraView cameraAt(const glm::dvec3& shift, const glm::vec3& up)
{
    return render::perspectiveView({shift + glm::dvec3(0.0, 1.0, 7.0), shift, up}, 0.9f, 1.0f, 0.1f);
}

class ViewInvariance : public ViewTest
{
protected:
    void SetUp() override
    {
        ViewTest::SetUp();
        makeTargets(kSize, kSize);
        clearPicture();
        auto& light = view_->settings().lighting;
        light.sunDirection = glm::normalize(glm::vec3(0.3f, 0.8f, 0.5f));
        light.sunIlluminance = glm::vec3(3.0f);
        light.skyLuminance = glm::vec3(0.3f, 0.4f, 0.5f);
    }
    void clearPicture(float value = 0.25f) { setPicture(std::vector<float>(kSize * kSize * 4, value)); }
};

double mean(const Picture& picture)
{
    double sum = 0.0;
    for (size_t i = 0; i < picture.texels.size(); i += 4)
        sum += double(picture.texels[i]);
    return sum / double(picture.texels.size() / 4);
}

} // namespace

TEST_F(ViewInvariance, rollingTheCameraRotatesThePicture)
{
    const auto snapshot = snapshotOf(cloud(60));
    const Picture upright = render(snapshot, cameraAt(glm::dvec3(0.0), {0.0f, 1.0f, 0.0f}));
    clearPicture();
    // the camera's up turns to its right side: the picture turns by a quarter to the left
    const auto rolled = cameraAt(glm::dvec3(0.0), {1.0f, 0.0f, 0.0f});
    const Picture turned = render(snapshot, rolled);
    double most = 0.0;
    for (int y = 0; y < kSize; ++y)
        for (int x = 0; x < kSize; ++x)
            for (int c = 0; c < 3; ++c)
                most = std::max(most, double(std::abs(upright.at(x, y)[c] - turned.at(kSize - 1 - y, x)[c])));
    EXPECT_LT(most, 1.0 / 255.0);
    EXPECT_GT(maxDifference(upright, turned), 0.1) << "the picture must not be symmetric by itself";
}

TEST_F(ViewInvariance, shiftingTheWorldByAHundredKilometresLeavesThePicture)
{
    const glm::dvec3 far(1e5, -3e4, 7e4);
    for (const bool isShadowed : {false, true}) {
        view_->settings().slices.enabled = isShadowed;
        clearPicture();
        const auto here = snapshotOf(cloud(60));
        const Picture a = render(here, cameraAt(glm::dvec3(0.0), {0.0f, 1.0f, 0.0f}));
        clearPicture();
        const auto there = snapshotOf(cloud(60), far);
        const Picture b = render(there, cameraAt(far, {0.0f, 1.0f, 0.0f}));
        // texels of light slices have fixed places in the world, so that the shift moves them through the
        // cloud
        EXPECT_LT(maxDifference(a, b), (isShadowed ? 11.0 : 1.0) / 255.0);
    }
}

TEST_F(ViewInvariance, aPlaneThatSplitsABallLeavesTheTotalTransmittance)
{
    const auto camera = cameraAt(glm::dvec3(0.0), {0.0f, 1.0f, 0.0f});
    const auto ball = snapshotOf({{{0.2f, 0.1f, 0.0f}, 1.4f, 3.0f}});
    const auto transmittance = [&](const render::CameraView& view, float plane) {
        clearPicture(1.0f);
        useDepth_ = false;
        if (plane > 0.0f)
            setDepth(std::vector<float>(kSize * kSize, 1.0f - 0.1f / plane));
        return render(ball, view);
    };
    const Picture whole = transmittance(camera, 0.0f);
    for (const float plane : {6.2f, 6.9f, 7.1f, 7.6f}) {
        const Picture front = transmittance(camera, plane);
        // what is behind the plane: the same rays, begun at the plane, which is then the near plane
        const auto behind = render::perspectiveView({{0.0, 1.0, 7.0}, {0.0, 0.0, 0.0}, {0.0f, 1.0f, 0.0f}},
                                                    0.9f, 1.0f, plane);
        const Picture back = transmittance(behind, 0.0f);
        double most = 0.0;
        for (int i = 0; i < kSize * kSize; ++i)
            most = std::max(
                most, std::abs(double(front.texels[size_t(i) * 4]) * double(back.texels[size_t(i) * 4]) -
                               double(whole.texels[size_t(i) * 4])));
        EXPECT_LT(most, 1e-5) << plane;
    }
}

TEST_F(ViewInvariance, theLayersAddUpToThePicture)
{
    const auto snapshot = snapshotOf(cloud(80));
    const auto camera = cameraAt(glm::dvec3(0.0), {0.0f, 1.0f, 0.0f});
    const Picture beauty = render(snapshot, camera);
    clearPicture();
    view_->settings().layerOutputs = true;
    const Picture again = render(snapshot, camera);
    const auto layers = view_->layers();
    const Picture fire = read(layers.fire);
    const Picture smoke = read(layers.smoke);
    const Picture dust = read(layers.dust);
    const Picture opticalDepth = read(layers.opticalDepth, 1);
    EXPECT_LT(maxDifference(beauty, again), 1e-5);
    double worst = 0.0;
    for (size_t i = 0; i < beauty.texels.size(); ++i) {
        const bool isAlpha = i % 4 == 3;
        const double sum = double(fire.texels[i]) + double(smoke.texels[i]) + double(dust.texels[i]);
        const size_t alpha = i / 4 * 4 + 3;
        const double opacity =
            double(fire.texels[alpha]) + double(smoke.texels[alpha]) + double(dust.texels[alpha]);
        if (isAlpha) {
            EXPECT_NEAR(opacity, -std::expm1(-double(opticalDepth.texels[i / 4])), 2e-5);
            continue;
        }
        const double recomposed = sum + (1.0 - opacity) * 0.25;
        worst = std::max(worst, std::abs(recomposed - double(beauty.texels[i])) /
                                    std::max(double(beauty.texels[i]), 1e-3));
    }
    EXPECT_LT(worst, 1e-3);
    EXPECT_GT(mean(fire), 0.01);
    EXPECT_GT(mean(smoke), 0.01);
    EXPECT_GT(mean(dust), 0.01);
}

TEST_F(ViewInvariance, nearSmokeHidesFarFireWhateverTheOrderOfTheList)
{
    const TestBlob smoke{{0.0f, 0.0f, 2.0f}, 1.0f, 8.0f};
    const TestBlob fire{{0.0f, 0.0f, -2.0f}, 1.0f, 8.0f, 5.0f, 0.0f, 0.0f, 0.0f, base::MediaLayer::Fire};
    const auto camera = render::perspectiveView({{0.0, 0.0, 8.0}, {0.0, 0.0, 0.0}}, 0.6f, 1.0f, 0.1f);
    const auto center = [&](const std::vector<TestBlob>& blobs) {
        clearPicture(0.0f);
        return double(render(snapshotOf(blobs), camera).at(kSize / 2, kSize / 2)[0]);
    };
    TestBlob nearFire = fire;
    TestBlob farSmoke = smoke;
    std::swap(nearFire.center, farSmoke.center);
    EXPECT_LT(center({smoke, fire}), 0.1);
    EXPECT_DOUBLE_EQ(center({smoke, fire}), center({fire, smoke}));
    EXPECT_GT(center({nearFire, farSmoke}), 4.5);
}

TEST_F(ViewInvariance, withoutEffectsThePictureIsTheHostsBitForBit)
{
    std::vector<float> noise(kSize * kSize * 4);
    for (size_t i = 0; i < noise.size(); ++i)
        noise[i] = base::randomUnit4(1, 0, i, base::RandomPurpose::Noise)[0] * 100.0f;
    setPicture(noise);
    base::FrameSnapshot empty(&schema_, std::pmr::get_default_resource());
    empty.begin(0, 1);
    const Picture picture = render(empty, cameraAt(glm::dvec3(0.0), {0.0f, 1.0f, 0.0f}));
    EXPECT_EQ(picture.texels, noise);
    EXPECT_EQ(view_->statistics().glCalls, 0u);
    EXPECT_EQ(view_->statistics().passes, 0u);
}

TEST_F(ViewInvariance, nonFiniteBlobsAreCountedAndNeverSeen)
{
    const auto camera = cameraAt(glm::dvec3(0.0), {0.0f, 1.0f, 0.0f});
    const auto good = cloud(10);
    const Picture a = render(snapshotOf(good), camera);
    auto bad = good;
    TestBlob poison = good[0];
    poison.center.x = std::numeric_limits<float>::quiet_NaN();
    bad.push_back(poison);
    poison = good[0];
    poison.crossSection = std::numeric_limits<float>::infinity();
    bad.push_back(poison);
    clearPicture();
    const Picture b = render(snapshotOf(bad), camera);
    EXPECT_EQ(view_->statistics().blobsNonFinite, 2u);
    EXPECT_EQ(maxDifference(a, b), 0.0);
}

TEST_F(ViewInvariance, aBallSmallerThanAPixelKeepsItsLight)
{
    const auto camera = cameraAt(glm::dvec3(0.0), {0.0f, 1.0f, 0.0f});
    const auto light = [&](float radius, float section) {
        clearPicture(0.0f);
        return mean(render(snapshotOf({{{0.05f, 0.02f, 0.0f}, radius, section, 1000.0f}}), camera));
    };
    // Thin: light is cross section times emission, whatever the radius.
    const double thin = light(0.3f, 1e-4f) / 1e-4;
    for (const float radius : {1e-2f, 3e-3f})
        EXPECT_NEAR(light(radius, 1e-3f * radius * radius) / (1e-3 * radius * radius * thin), 1.0, 0.05)
            << radius;
    // Opaque: emission times the area of its disc, all but the rim of which is covered.
    for (const float radius : {1e-2f, 3e-3f, 1e-3f}) {
        const double covered =
            light(radius, 1e4f * radius * radius) / (std::numbers::pi * radius * radius * thin);
        EXPECT_NEAR(covered, 0.98, 0.06) << radius;
    }
    EXPECT_EQ(light(1e-30f, 1e-4f), 0.0); // no area
}

TEST_F(ViewInvariance, afterTheWarmUpNoFrameCompiles)
{
    ASSERT_TRUE(view_->warmUp().ok());
    for (const bool layers : {false, true}) {
        view_->settings().layerOutputs = layers;
        render(snapshotOf(cloud(10)), cameraAt(glm::dvec3(0.0), {0.0f, 1.0f, 0.0f}));
        EXPECT_EQ(view_->statistics().programsCompiled, 0u);
    }
    EXPECT_EQ(device_->lateCompiles(), 0u);
}

TEST_F(ViewInvariance, flyingThroughACloudThePictureNeverJumps)
{
    // A jump keeps its size when the path is cut finer. A motion shrinks with the step, here to 1/8; the test
    // allows 1/4, because the light of the gas on itself also changes in small steps (0.207 measured). Light
    // varies smoothly through a gas. Where overlapping blobs differ strongly, a change of order is visible.
    std::vector<TestBlob> gas = cloud(120);
    for (TestBlob& blob : gas) {
        blob.layer = base::MediaLayer::Smoke;
        blob.emission = 0.5f + 0.12f * blob.center.y;
    }
    const auto snapshot = snapshotOf(gas);
    const auto largestChange = [&](double from, double to, int frames) {
        double before = 0.0;
        double most = 0.0;
        for (int frame = 0; frame <= frames; ++frame) {
            clearPicture();
            const double z = from + (to - from) * frame / frames;
            const auto camera =
                render::perspectiveView({{0.3, 0.2, z}, {0.3, 0.2, z - 1.0}}, 0.9f, 1.0f, 0.05f);
            const double now = mean(render(snapshot, camera));
            most = frame > 0 ? std::max(most, std::abs(now - before)) : 0.0;
            before = now;
        }
        return most;
    };
    const double coarse = largestChange(7.0, -5.0, 100);
    const double fine = largestChange(7.0, -5.0, 800);
    EXPECT_LT(fine, 0.25 * coarse) << fine << " after " << coarse;
}

TEST_F(ViewInvariance, coldGasWithDetailIsDarkAndFinite)
{
    for (const float temperature : {1.0f, 20.0f, 293.0f}) {
        auto snapshot = snapshotOf(cloud(30));
        auto& group = const_cast<base::SnapshotGroup&>(snapshot.group(1));
        group.editConstants()[base::blob_constant::DetailAmount] = 1.0f;
        group.editConstants()[base::blob_constant::DetailScale] = 1.0f;
        for (uint32_t i = 0; i < group.count(); ++i) {
            group.editColumn(base::blob_column::Temperature)[i] = temperature;
            for (size_t k = 0; k < 3; ++k) // light of its own does not follow the temperature
                group.editColumn(base::blob_column::EmissionR + k)[i] =
                    0.1f / render::exposureFromEv100(kEv100);
        }
        clearPicture();
        const Picture picture = render(snapshot, cameraAt(glm::dvec3(0.0), {0.0f, 1.0f, 0.0f}));
        for (const float texel : picture.texels)
            ASSERT_TRUE(texel >= 0.0f && texel < 2.0f) << texel << " at " << temperature << " K";
    }
}

TEST_F(ViewInvariance, anEffectFarAwayDoesNotChangeTheLightOnThisOne)
{
    const auto camera = cameraAt(glm::dvec3(0.0), {0.0f, 1.0f, 0.0f});
    auto here = snapshotOf(cloud(40));
    const Picture alone = render(here, camera);
    auto& far = here.addGroup(schema_.find("blob"), 1);
    for (size_t c = 0; c < base::blob_column::Count; ++c)
        far.editColumn(c)[0] = 0.0f;
    far.editColumn(base::blob_column::Radius)[0] = 2.0f;
    far.editColumn(base::blob_column::CrossSection)[0] = 10.0f;
    far.editInfo().count = 1;
    far.editInfo().instance = 99;
    far.editInfo().placement.position = {0.0, 0.0, 1000.0};
    clearPicture();
    EXPECT_EQ(maxDifference(alone, render(here, camera)), 0.0);
}
