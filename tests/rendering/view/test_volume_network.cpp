// Illumination networks in pictures: a furnace, light that is scattered again against what one scattering and
// none lost leave, rest, and light that follows what moves.
#include "tests/rendering/view/view_fixture.h"

#include <algorithm>
#include <cmath>

using namespace fx;
using namespace fx::test;

namespace {

constexpr int kWidth = 64, kHeight = 48;

/// Networks in the compositions that have them.
class NetworkPictures : public ViewTest, public testing::WithParamInterface<render::Composition>
{
protected:
    void SetUp() override
    {
        ViewTest::SetUp();
        makeTargets(kWidth, kHeight);
        render::ViewSettings& settings = view_->settings();
        settings.composition = GetParam();
        settings.voxels = 64;
        settings.slices.network = true;
        settings.slices.networkCells = 24;
        settings.lighting.sunIlluminance = glm::vec3(0.0f);
        settings.lighting.skyLuminance = glm::vec3(0.0f);
        settings.lighting.groundAlbedo = 0.0f;
    }
    Picture drawn(const base::FrameSnapshot& snapshot)
    {
        setPicture(std::vector<float>(size_t(color_->width()) * size_t(color_->height()) * 4, 0.0f));
        return render(snapshot, camera());
    }
    static render::CameraView camera()
    {
        return render::perspectiveView({{0.0, 0.0, 6.0}, {0.0, 0.0, 0.0}, {0.0f, 1.0f, 0.0f}}, 0.8f,
                                       float(kWidth) / float(kHeight), 0.05f);
    }
    static TestBlob ball(float crossSection, float albedo)
    {
        TestBlob blob{{0.1f, -0.2f, 0.0f}, 1.5f, crossSection};
        blob.albedo = albedo;
        return blob;
    }
    static base::FrameSnapshot withAnisotropy(base::FrameSnapshot snapshot, float anisotropy)
    {
        for (size_t g = 0; g < snapshot.groupCount(); ++g)
            snapshot.editGroup(g).editConstants()[base::blob_constant::Anisotropy] = anisotropy;
        return snapshot;
    }
    size_t sweeps() const
    {
        return size_t(std::ranges::count(view_->executedPasses(), std::string_view("network rays")));
    }
    size_t networkPasses() const
    {
        return size_t(std::ranges::count_if(
            view_->executedPasses(), [](std::string_view name) { return name.starts_with("network"); }));
    }
    static double brightness(const Picture& picture)
    {
        double sum = 0.0;
        for (size_t i = 0; i < picture.texels.size(); i += 4)
            sum += double(picture.texels[i]);
        return sum;
    }
};

} // namespace

INSTANTIATE_TEST_SUITE_P(, NetworkPictures,
                         testing::Values(render::Composition::Volume, render::Composition::Slabs),
                         [](const auto& chosen) {
                             return chosen.param == render::Composition::Volume ? "volume" : "slabs";
                         });

TEST_P(NetworkPictures, aWhiteMediumUnderAWhiteSkyIsNotTold)
{
    view_->settings().lighting.skyLuminance = glm::vec3(1000.0f);
    view_->settings().lighting.groundAlbedo = 1.0f;
    const base::FrameSnapshot snapshot = snapshotOf({ball(6.0f, 1.0f)});
    Picture picture = drawn(snapshot);
    for (int i = 0; i < 60; ++i) // albedo 1: light takes its time
        picture = drawn(snapshotOf({ball(6.0f, 1.0f)}));
    float least = 1e9f, most = 0.0f;
    for (size_t i = 0; i < picture.texels.size(); i += 4)
        if (picture.texels[i + 3] > 0.2f) {
            const float luminance = picture.texels[i] / picture.texels[i + 3];
            least = std::min(least, luminance);
            most = std::max(most, luminance);
        }
    EXPECT_GT(least, 0.0f);
    EXPECT_LT(most / least, 1.01f) << "it has the luminance of the sky everywhere";
}

TEST_P(NetworkPictures, blackMediaScatterNothingAndWhiteOnesMoreThanOnce)
{
    view_->settings().lighting.sunIlluminance = glm::vec3(10000.0f);
    const auto lit = [&](float albedo, bool multiple) {
        view_->settings().slices.multiple = multiple;
        return brightness(drawn(snapshotOf({ball(6.0f, albedo)})));
    };
    EXPECT_EQ(lit(0.0f, true), 0.0);
    const double once = lit(0.9f, false), again = lit(0.9f, true);
    EXPECT_GT(again, 1.5 * once);
    EXPECT_LT(again, 10.0 * once) << "no more than 1 / (1 - albedo)";
    const double little = lit(0.05f, true) / lit(0.05f, false);
    EXPECT_GT(little, 1.0);
    EXPECT_LT(little, 1.06) << "what is scattered twice has the albedo twice";
}

TEST_P(NetworkPictures, atRestThereIsNoPassAndThePictureStays)
{
    view_->settings().lighting.sunIlluminance = glm::vec3(10000.0f);
    const base::FrameSnapshot snapshot = snapshotOf({ball(6.0f, 0.9f)});
    drawn(snapshotOf({ball(5.0f, 0.9f)}));
    EXPECT_GE(sweeps(), 8u) << "from darkness";
    drawn(snapshot);
    EXPECT_EQ(sweeps(), 2u) << "the medium has changed";
    size_t after = 0;
    for (int i = 0; i < 20 && networkPasses() > 0; ++i) {
        drawn(snapshot);
        after += sweeps();
    }
    EXPECT_GT(after, 4u) << "the light comes to rest after the medium";
    const Picture first = drawn(snapshot);
    EXPECT_EQ(networkPasses(), 0u);
    const Picture second = drawn(snapshot);
    EXPECT_EQ(networkPasses(), 0u);
    EXPECT_EQ(maxDifference(first, second), 0.0);
    drawn(snapshotOf({ball(5.0f, 0.9f)}));
    EXPECT_EQ(sweeps(), 2u);
}

TEST_P(NetworkPictures, lightThatFollowsIsThatOfAFrameOfItsOwn)
{
    view_->settings().lighting.sunIlluminance = glm::vec3(10000.0f);
    for (int i = 0; i < 12; ++i) {
        TestBlob moving = ball(6.0f, 0.9f);
        moving.center.x = 0.05f * float(i);
        drawn(snapshotOf({moving}));
    }
    TestBlob last = ball(6.0f, 0.9f);
    last.center.x = 0.6f;
    const Picture followed = drawn(snapshotOf({last}));
    drawn(snapshotOf({})); // the light is forgotten
    const Picture own = drawn(snapshotOf({last}));
    double difference = 0.0;
    for (size_t i = 0; i < own.texels.size(); i += 4)
        difference += std::abs(double(followed.texels[i]) - double(own.texels[i]));
    EXPECT_LT(difference / brightness(own), 0.02);
}

TEST_P(NetworkPictures, automaticallyOnlyMediaThatGainFromItHaveOne)
{
    render::ViewSettings& settings = view_->settings();
    settings.lighting.sunIlluminance = glm::vec3(10000.0f);
    const auto sweepsOf = [&](const std::vector<TestBlob>& blobs, bool automatic) {
        settings.slices.automatic = automatic;
        drawn(snapshotOf({}));
        drawn(snapshotOf(blobs));
        return sweeps();
    };
    const auto large = [](float crossSection, float albedo) { // on the picture
        TestBlob blob = ball(crossSection, albedo);
        blob.radius = 2.0f;
        return blob;
    };
    TestBlob far = large(20.0f, 0.9f);
    far.center.z = -100.0f;
    for (const TestBlob& without : {large(0.3f, 0.9f), large(20.0f, 0.2f), far}) {
        EXPECT_EQ(sweepsOf({without}, true), 0u);
        EXPECT_GT(sweepsOf({without}, false), 0u) << "on request";
    }
    const TestBlob dense = large(20.0f, 0.9f);
    EXPECT_GT(sweepsOf({dense}, true), 0u);
    settings.voxels = 32;
    EXPECT_EQ(sweepsOf({dense}, true), 0u) << "what a budget leaves";
    EXPECT_GT(sweepsOf({dense}, false), 0u);
}

TEST_P(NetworkPictures, withoutANetworkAutomaticPicturesAreThoseOfTheClosedForm)
{
    render::SliceSettings& slices = view_->settings().slices;
    view_->settings().lighting.sunIlluminance = glm::vec3(10000.0f);
    TestBlob fire = ball(6.0f, 0.1f);
    fire.emission = 50.0f;
    slices.automatic = true;
    const Picture automatic = drawn(snapshotOf({fire}));
    const bool hasGlow = GetParam() == render::Composition::Volume;
    EXPECT_EQ(std::ranges::count(view_->executedPasses(), std::string_view("glow source")), hasGlow ? 2 : 0)
        << "with the light of fire in its grid";
    slices.network = false;
    EXPECT_EQ(maxDifference(automatic, drawn(snapshotOf({fire}))), 0.0);
    slices.network = true;
    slices.automatic = false;
    EXPECT_GT(maxDifference(automatic, drawn(snapshotOf({fire}))), 0.0);
}

TEST_P(NetworkPictures, smokeThatScattersForwardIsBrighterBeforeFireThanBehindIt)
{
    // Light of smoke beside the fire's disk, per scattering forward and backward.
    const auto besideFire = [&](float place, float anisotropy) {
        TestBlob smoke{{}, 1.6f, 1.5f};
        smoke.albedo = 0.9f;
        TestBlob fire{{0.0f, 0.0f, place}, 0.3f, 1.0f};
        fire.emission = 100.0f;
        drawn(snapshotOf({}));
        const Picture picture = drawn(withAnisotropy(snapshotOf({fire, smoke}), anisotropy));
        double sum = 0.0;
        for (int y = 0; y < kHeight; ++y)
            for (int x = 0; x < kWidth; ++x) {
                const double away = std::hypot(x + 0.5 - 0.5 * kWidth, y + 0.5 - 0.5 * kHeight);
                sum += away > 8.0 && away < 12.0 ? double(picture.at(x, y)[0]) : 0.0;
            }
        return sum;
    };
    const double isotropic = besideFire(-2.0f, 0.0f) / besideFire(2.0f, 0.0f);
    const double forward = besideFire(-2.0f, 0.33f) / besideFire(2.0f, 0.33f);
    EXPECT_GT(forward, 1.5 * isotropic);
}

TEST_P(NetworkPictures, aGridThatGrowsGoesOnFromItsLight)
{
    view_->settings().lighting.sunIlluminance = glm::vec3(10000.0f);
    TestBlob dense{{0.0f, -0.8f, 0.0f}, 1.0f, 20.0f}, wisp{{0.0f, 1.6f, 0.0f}, 0.8f, 1e-3f};
    dense.albedo = wisp.albedo = 0.98f;
    const auto settled = [&](const std::vector<TestBlob>& blobs) {
        for (int i = 0; i < 20; ++i)
            drawn(snapshotOf(blobs));
        return brightness(drawn(snapshotOf(blobs)));
    };
    settled({dense});
    const double next = brightness(drawn(snapshotOf({dense, wisp}))); // in other cells
    EXPECT_EQ(sweeps(), 2u);
    EXPECT_NEAR(next / settled({dense, wisp}), 1.0, 0.05);
}

TEST_P(NetworkPictures, mediaApartHaveTheLightThatTheyHaveAlone)
{
    view_->settings().lighting.sunIlluminance = glm::vec3(10000.0f);
    view_->settings().lighting.sunDirection = {0.0f, 1.0f, 0.0f};
    TestBlob dense{{-2.4f, 0.0f, 0.0f}, 0.5f, 3.0f}, thin{{2.4f, 0.0f, 0.0f}, 0.5f, 0.4f};
    dense.albedo = thin.albedo = 0.95f;
    thin.layer = base::MediaLayer::Dust;
    const auto shown = [&](const std::vector<TestBlob>& blobs) {
        Picture picture = drawn(snapshotOf({}));
        for (int i = 0; i < 8; ++i) { // each goes on from the light of the frame before
            base::FrameSnapshot snapshot = snapshotOf(blobs);
            for (size_t g = 0; g < snapshot.groupCount(); ++g)
                snapshot.editGroup(g).editInfo().instance = g + 1; // fields of their own
            picture = drawn(snapshot);
        }
        return picture;
    };
    const Picture both = shown({dense, thin}), one = shown({dense}), other = shown({thin});
    double difference = 0.0;
    for (size_t i = 0; i < both.texels.size(); i += 4)
        difference += std::abs(double(both.texels[i]) - double(one.texels[i]) - double(other.texels[i]));
    EXPECT_LT(difference, 0.05 * brightness(both)) << "light slices of both are coarser";
    EXPECT_GT(brightness(one), 1.2 * brightness(other)) << "their light differs";
}

TEST_P(NetworkPictures, fireInsideLightsTheMediumAroundIt)
{
    TestBlob fire = ball(2.0f, 0.0f);
    fire.radius = 0.5f;
    fire.emission = 50.0f;
    const double alone = brightness(drawn(snapshotOf({fire})));
    const double inBlack = brightness(drawn(snapshotOf({fire, ball(3.0f, 0.0f)})));
    const double inWhite = brightness(drawn(snapshotOf({fire, ball(3.0f, 0.95f)})));
    EXPECT_LT(inBlack, 0.7 * alone);
    EXPECT_GT(inWhite, 1.5 * inBlack) << "what the smoke takes from the fire, it shows";
}

/// Light that has been scattered through small angles alone is part of the beam: a medium that scatters
/// forward shades itself by 1 - albedo f of its optical depth, f = (3 g - 1) / 2 for g 0.85.
TEST_P(NetworkPictures, aBeamGoesOnAfterItHasBeenScatteredForward)
{
    constexpr double kAnisotropy = 0.85, kAlbedo = 0.9, kRadius = 1.5, kCrossSection = 11.0;
    constexpr double kPi = 3.14159265358979;
    const double depth = 3.5 / kPi * kCrossSection / (kRadius * kRadius); // through the middle
    const double straight = 1.0 - kAlbedo * (1.5 * kAnisotropy - 0.5);
    // Over the medium the integral of exp(-straight t) exp(-(depth - t)) dt: the light is behind the medium.
    const double expected = (std::exp(-straight * depth) - std::exp(-depth)) / (1.0 - straight);
    const double withoutPeak = depth * std::exp(-depth);
    ASSERT_GT(expected, 5.0 * withoutPeak);
    const double phase =
        (1.0 - kAnisotropy * kAnisotropy) / (4.0 * kPi * std::pow(1.0 - kAnisotropy, 3.0)); // straight on
    const auto lit = [&](float albedo) { // in the middle of the picture
        TestBlob medium{{}, float(kRadius), float(kCrossSection)};
        medium.albedo = albedo;
        drawn(snapshotOf({}));
        const Picture picture = drawn(withAnisotropy(snapshotOf({medium}), float(kAnisotropy)));
        return double(picture.at(kWidth / 2, kHeight / 2)[0]);
    };
    view_->settings().lighting.sunDirection = {0.0f, 0.0f, -1.0f};
    view_->settings().lighting.sunIlluminance = glm::vec3(1000.0f);
    const double ofSun = lit(float(kAlbedo)) / (1000.0 * kAlbedo * phase / 1.2);
    // The network adds what its two bands have of wider angles, a few per cent of this phase function.
    EXPECT_GT(ofSun, 0.9 * expected);
    EXPECT_LT(ofSun, 1.35 * expected);

    view_->settings().lighting.sunIlluminance = glm::vec3(0.0f);
    render::HostLights& host = view_->settings().hostLights;
    host.lights[0].position = {0.0, 0.0, -12.0}; // 1000 lx in the middle of the medium
    host.lights[0].intensity = glm::vec3(1000.0f * 12.0f * 12.0f);
    host.lights[0].radius = 0.1f;
    host.count = 1;
    const double ofLamp = lit(float(kAlbedo)) / (1000.0 * kAlbedo * phase / 1.2);
    EXPECT_GT(ofLamp, 0.6 * expected) << "nearer to the eye it is farther from the lamp";
    EXPECT_LT(ofLamp, 1.5 * expected);
}

namespace {

/// A lumpy cloud of balls of several sizes.
std::vector<TestBlob> lumps(float albedo)
{
    std::vector<TestBlob> blobs;
    for (int i = 0; i < 24; ++i) {
        const float angle = 2.4f * float(i), height = -1.0f + 2.0f * (float(i) + 0.5f) / 24.0f;
        const float across = 1.1f * std::sqrt(1.0f - height * height);
        TestBlob blob{{across * std::cos(angle), 1.1f * height, across * std::sin(angle)},
                      0.45f + 0.02f * float(i % 7),
                      0.25f + 0.02f * float(i % 5)};
        blob.albedo = albedo;
        blobs.push_back(blob);
    }
    return blobs;
}

/// [1] Root mean square difference of two pictures relative to the root mean square of the second.
double relativeDifference(const Picture& a, const Picture& b)
{
    double squares = 0.0, all = 0.0;
    for (size_t i = 0; i < b.texels.size(); i += 4) {
        const double difference = double(a.texels[i]) - double(b.texels[i]);
        squares += difference * difference;
        all += double(b.texels[i]) * double(b.texels[i]);
    }
    return std::sqrt(squares / all);
}

} // namespace

using NetworkOfSlabs = NetworkPictures;
INSTANTIATE_TEST_SUITE_P(, NetworkOfSlabs, testing::Values(render::Composition::Slabs),
                         [](const auto&) { return "slabs"; });

TEST_P(NetworkOfSlabs, hasTheLightOfVoxels)
{
    render::ViewSettings& settings = view_->settings();
    settings.lighting.sunIlluminance = glm::vec3(10000.0f);
    settings.lighting.skyLuminance = glm::vec3(1000.0f);
    settings.lighting.groundAlbedo = 0.3f;
    const auto pictured = [&](render::Composition composition, bool network, float anisotropy) {
        settings.composition = composition;
        settings.slices.network = network;
        drawn(snapshotOf({}));
        return drawn(withAnisotropy(snapshotOf(lumps(0.95f)), anisotropy));
    };
    for (const glm::vec3& sun :
         {glm::vec3(0.0f, 0.6f, 0.8f), glm::vec3(0.8f, 0.6f, 0.0f), glm::vec3(0.6f, 0.0f, -0.8f)})
        for (const float anisotropy : {0.0f, 0.5f}) {
            settings.lighting.sunDirection = sun;
            const Picture voxels = pictured(render::Composition::Volume, true, anisotropy);
            const Picture slabs = pictured(render::Composition::Slabs, true, anisotropy);
            const double formula =
                relativeDifference(pictured(render::Composition::Slabs, false, anisotropy), voxels);
            EXPECT_LT(relativeDifference(slabs, voxels), 0.04) << sun.x << " " << anisotropy;
            EXPECT_GT(formula, 2.0 * relativeDifference(slabs, voxels)) << "the closed form is another light";
            EXPECT_NEAR(brightness(slabs) / brightness(voxels), 1.0, 0.02);
        }
}

TEST_P(NetworkOfSlabs, isAlikeWithPicturesOfMotionAndDepth)
{
    render::ViewSettings& settings = view_->settings();
    settings.lighting.sunIlluminance = glm::vec3(10000.0f);
    const Picture alone = drawn(snapshotOf(lumps(0.9f)));
    drawn(snapshotOf({}));
    settings.outputs = render::view_output::kAll;
    const base::FrameSnapshot snapshot = snapshotOf(lumps(0.9f));
    EXPECT_EQ(maxDifference(drawn(snapshot), alone), 0.0);
    for (int i = 0; i < 12; ++i)
        drawn(snapshot); // to rest
    EXPECT_EQ(networkPasses(), 0u);
    EXPECT_LT(relativeDifference(drawn(snapshot), alone), 0.02);
}

TEST_P(NetworkOfSlabs, withoutANetworkHasNoFields)
{
    view_->settings().lighting.sunIlluminance = glm::vec3(10000.0f);
    const auto fieldPasses = [&] {
        return std::ranges::count_if(view_->executedPasses(), [](std::string_view name) {
            return name.starts_with("field") || name.starts_with("network") || name.starts_with("glow");
        });
    };
    view_->settings().slices.network = false;
    const Picture before = drawn(snapshotOf(lumps(0.9f)));
    EXPECT_EQ(fieldPasses(), 0);
    view_->settings().slices.network = true;
    drawn(snapshotOf(lumps(0.9f)));
    EXPECT_GT(fieldPasses(), 0);
    view_->settings().slices.network = false;
    EXPECT_EQ(maxDifference(before, drawn(snapshotOf(lumps(0.9f)))), 0.0) << "and nothing of it is left";
    EXPECT_EQ(fieldPasses(), 0);
}

TEST_P(NetworkOfSlabs, sixSlabsAndLayersHaveItsLight)
{
    render::ViewSettings& settings = view_->settings();
    settings.lighting.sunIlluminance = glm::vec3(10000.0f);
    settings.slabs = 6;
    const Picture six = drawn(snapshotOf(lumps(0.9f)));
    settings.slabs = 16;
    const Picture sixteen = drawn(snapshotOf(lumps(0.9f)));
    EXPECT_LT(relativeDifference(six, sixteen), 0.06);
    settings.layerOutputs = true;
    const Picture layered = drawn(snapshotOf(lumps(0.9f)));
    EXPECT_LT(relativeDifference(layered, sixteen), 0.02);
}
