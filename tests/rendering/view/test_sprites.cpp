// Sprites on the picture against what follows from their sizes, colors and textures by hand.
#include "particle_fixture.h"

#include "rendering/frame/exposure.h"

#include <glm/geometric.hpp>

#include <cmath>
#include <numbers>

using namespace fx;
using namespace fx::test;
namespace constant = base::particle_constant;

namespace {

/// An image of one color.
std::vector<uint8_t> plain(int width, int height, uint8_t r, uint8_t g, uint8_t b, uint8_t a)
{
    std::vector<uint8_t> rgba;
    for (int i = 0; i < width * height; ++i)
        rgba.insert(rgba.end(), {r, g, b, a});
    return rgba;
}

class SpriteTest : public ParticleTest
{
protected:
    static constexpr int kSide = 100; ///< [pixel] 10 a metre with flatCamera()

    void SetUp() override
    {
        ParticleTest::SetUp();
        makeTargets(kSide, kSide);
        setPicture(std::vector<float>(size_t(kSide) * kSide * 4, 0.0f));
        white_ = float(*assets_.addImage(4, 4, true, plain(4, 4, 255, 255, 255, 255)));
    }
    void clearPicture(float value = 0.0f)
    {
        setPicture(std::vector<float>(size_t(kSide) * kSide * 4, value));
    }
    Picture draw(const base::FrameSnapshot& snapshot)
    {
        return renderPair(snapshot, nullptr, 1.0, flatCamera());
    }
    static int litPixels(const Picture& picture)
    {
        int count = 0;
        for (int y = 0; y < kSide; ++y)
            for (int x = 0; x < kSide; ++x)
                count += picture.at(x, y)[1] > 0.0f ? 1 : 0;
        return count;
    }
    float white_ = 0.0f;
};

} // namespace

TEST_F(SpriteTest, aSquareCoversItsSquareAndNothingElse)
{
    auto snapshot = emptySnapshot();
    auto& group = addParticles(snapshot, {{{1.0f, -2.0f, 0.0f}, 1.0f, {0.25f, 0.5f, 1.0f, 1.0f}}});
    set(group, constant::Texture, white_);
    const Picture picture = draw(snapshot);
    for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x) {
            const bool inside = x >= 50 && x < 70 && y >= 20 && y < 40; // 1 m about (1, -2)
            ASSERT_EQ(picture.at(x, y)[0], inside ? 0.25f : 0.0f) << x << ", " << y;
            ASSERT_EQ(picture.at(x, y)[2], inside ? 1.0f : 0.0f) << x << ", " << y;
        }
}

TEST_F(SpriteTest, aspectMakesItWideAndTheAngleTurnsIt)
{
    auto snapshot = emptySnapshot();
    TestParticle p;
    p.angle = std::numbers::pi_v<float> / 2;
    auto& group = addParticles(snapshot, {p});
    set(group, constant::Texture, white_);
    set(group, constant::Aspect, 3.0f);
    const Picture picture = draw(snapshot);
    EXPECT_GT(picture.at(50, 78)[0], 0.5f) << "3 m to the side, turned upright";
    EXPECT_EQ(picture.at(78, 50)[0], 0.0f);
    EXPECT_EQ(litPixels(picture), 20 * 60);
}

TEST_F(SpriteTest, theAngleTurnsCounterclockwise)
{
    std::vector<uint8_t> half = plain(4, 4, 255, 255, 255, 0);
    for (int y = 0; y < 4; ++y)
        for (int x = 2; x < 4; ++x)
            half[size_t((y * 4 + x) * 4 + 3)] = 255; // the right half is there
    auto snapshot = emptySnapshot();
    TestParticle p;
    p.radius = 2.0f;
    p.angle = std::numbers::pi_v<float> / 2;
    set(addParticles(snapshot, {p}), constant::Texture, float(*assets_.addImage(4, 4, true, half)));
    const Picture picture = draw(snapshot);
    EXPECT_GT(picture.at(50, 65)[0], 0.9f) << "right becomes up";
    EXPECT_EQ(picture.at(50, 34)[0], 0.0f);
}

TEST_F(SpriteTest, emptyRowsAndRowsOfAnEmptyGroupShowNothing)
{
    auto snapshot = emptySnapshot();
    TestParticle gone;
    gone.radius = 0.0f;
    addParticles(snapshot, {gone, gone});
    addParticles(snapshot, {});
    EXPECT_EQ(litPixels(draw(snapshot)), 0);
}

TEST_F(SpriteTest, alphaCoversAdditiveAdds)
{
    for (const bool additive : {false, true}) {
        clearPicture(0.5f);
        auto snapshot = emptySnapshot();
        auto& group = addParticles(snapshot, {{{0, 0, 0}, 1.0f, {1.0f, 1.0f, 1.0f, 0.25f}}});
        set(group, constant::Texture, white_);
        set(group, constant::Blend,
            float(additive ? base::ParticleBlend::Additive : base::ParticleBlend::Alpha));
        EXPECT_NEAR(draw(snapshot).at(50, 50)[0], additive ? 0.75f : 0.25f + 0.75f * 0.5f, 1e-6f);
    }
}

TEST_F(SpriteTest, sortedSpritesCoverByDistanceAndUnsortedOnesByRow)
{
    const std::vector<TestParticle> particles{{{0, 0, 1}, 1.0f, {1, 0, 0, 1}},
                                              {{0, 0, -1}, 1.0f, {0, 1, 0, 1}}};
    const std::pair<base::ParticleOrder, int> expected[] = {{base::ParticleOrder::Depth, 0},
                                                            {base::ParticleOrder::None, 1}};
    for (const auto& [order, seen] : expected) {
        clearPicture();
        auto snapshot = emptySnapshot();
        auto& group = addParticles(snapshot, particles);
        set(group, constant::Texture, white_);
        set(group, constant::Order, float(order));
        EXPECT_EQ(draw(snapshot).at(50, 50)[seen], 1.0f) << int(order);
    }
}

TEST_F(SpriteTest, ageOrdersBothWays)
{
    std::vector<TestParticle> particles{{{0, 0, 1}, 1.0f, {1, 0, 0, 1}}, {{0, 0, -1}, 1.0f, {0, 1, 0, 1}}};
    particles[0].age = 2.0f;
    particles[1].age = 1.0f;
    for (const bool oldestFirst : {true, false}) {
        clearPicture();
        auto snapshot = emptySnapshot();
        auto& group = addParticles(snapshot, particles);
        set(group, constant::Texture, white_);
        set(group, constant::Order,
            float(oldestFirst ? base::ParticleOrder::Oldest : base::ParticleOrder::Youngest));
        EXPECT_EQ(draw(snapshot).at(50, 50)[oldestFirst ? 1 : 0], 1.0f) << "who is drawn last is seen";
    }
}

TEST_F(SpriteTest, groupsCoverByDistanceAndBiasBringsOneToTheFront)
{
    for (const float bias : {0.0f, 5.0f}) {
        clearPicture();
        auto snapshot = emptySnapshot();
        auto& near = addParticles(snapshot, {{{0, 0, 1}, 1.0f, {1, 0, 0, 1}}});
        set(near, constant::Texture, white_);
        auto& far = addParticles(snapshot, {{{0, 0, -1}, 1.0f, {0, 1, 0, 1}}});
        set(far, constant::Texture, white_);
        set(far, constant::OrderBias, bias);
        EXPECT_EQ(draw(snapshot).at(50, 50)[bias > 0.0f ? 1 : 0], 1.0f);
    }
}

TEST_F(SpriteTest, solidThingsHideAndSoftnessFadesTowardsThem)
{
    // parallel projection from 0.1 m to 100 m: stored depth of the plane z = 0, 10 m away
    const float stored = (10.0f - 0.1f) / (100.0f - 0.1f);
    setDepth(std::vector<float>(size_t(kSide) * kSide, stored));
    const std::pair<float, float> expected[] = {{-1.0f, 0.0f}, {0.25f, 0.25f}, {0.5f, 0.5f}, {2.0f, 1.0f}};
    for (const auto& [z, alpha] : expected) {
        clearPicture();
        auto snapshot = emptySnapshot();
        auto& group = addParticles(snapshot, {{{0, 0, z}, 1.0f}});
        set(group, constant::Texture, white_);
        set(group, constant::Softness, 1.0f);
        EXPECT_NEAR(draw(snapshot).at(50, 50)[0], alpha, 2e-4f) << z;
    }
}

TEST_F(SpriteTest, opaqueSpritesHideEachOtherInAnyOrderAndEverythingBehindThem)
{
    auto snapshot = emptySnapshot();
    auto& glow =
        addParticles(snapshot, {{{0, 0, -3}, 3.0f, {0, 0, 1, 1}}, {{0, 0, 3}, 0.5f, {0, 0, 1, 0.5f}}});
    set(glow, constant::Texture, white_);
    auto& solid = addParticles(snapshot, {{{0, 0, 1}, 1.0f, {1, 0, 0, 1}}, {{0, 0, -1}, 2.0f, {0, 1, 0, 1}}});
    set(solid, constant::Texture, white_);
    set(solid, constant::Blend, float(base::ParticleBlend::Opaque));
    const Picture picture = draw(snapshot);
    EXPECT_EQ(picture.at(57, 50)[0], 1.0f) << "the nearer is seen";
    EXPECT_EQ(picture.at(57, 50)[2], 0.0f) << "what glows behind is not";
    EXPECT_EQ(picture.at(65, 50)[1], 1.0f) << "the farther beside it";
    EXPECT_EQ(picture.at(75, 50)[2], 1.0f) << "and the glow beside both";
    EXPECT_NEAR(picture.at(50, 50)[0], 0.5f, 1e-6f) << "what is in front covers";
    EXPECT_NEAR(picture.at(50, 50)[2], 0.5f, 1e-6f);
}

TEST_F(SpriteTest, velocityAlignsAndStretches)
{
    auto snapshot = emptySnapshot();
    TestParticle p;
    p.radius = 0.5f;
    p.velocity = {4.0f, 0.0f, 0.0f};
    auto& group = addParticles(snapshot, {p});
    set(group, constant::Texture, white_);
    set(group, constant::Alignment, float(base::SpriteAlignment::Velocity));
    set(group, constant::Stretch, 1.0f);
    const Picture picture = draw(snapshot);
    EXPECT_EQ(litPixels(picture), 50 * 10) << "4 m longer than its 1 m";
    EXPECT_GT(picture.at(74, 50)[0], 0.0f);
    EXPECT_EQ(picture.at(50, 56)[0], 0.0f);
}

TEST_F(SpriteTest, onAPlaneItIsSeenInPerspectiveAndFromBehind)
{
    auto snapshot = emptySnapshot();
    auto& group = addParticles(snapshot, {{{0, 0, 0}, 1.0f}});
    set(group, constant::Texture, white_);
    set(group, constant::Alignment, float(base::SpriteAlignment::Plane));
    set(group, constant::AxisY, 0.5f); // 60 degrees from facing the camera
    set(group, constant::AxisZ, -std::sqrt(0.75f));
    const int pixels = litPixels(draw(snapshot));
    EXPECT_NEAR(pixels, 400 * std::sqrt(0.75), 30);
}

TEST_F(SpriteTest, aFlatWhiteSpriteInAFurnaceIsAsBrightAsTheFurnace)
{
    // light of luminance L from everywhere: what scatters all of it shows L
    const float exposure = render::exposureFromEv100(kEv100);
    view_->settings().lighting.skyLuminance = glm::vec3(0.7f / exposure);
    view_->settings().lighting.groundAlbedo = 1.0f;
    view_->settings().lighting.sunIlluminance = glm::vec3(0.0f);
    auto snapshot = emptySnapshot();
    auto& group = addParticles(snapshot, {{{0, 0, 0}, 1.0f}});
    set(group, constant::Texture, white_);
    set(group, constant::Luminance, 0.0f);
    set(group, constant::Lit, 1.0f);
    EXPECT_NEAR(draw(snapshot).at(50, 50)[0], 0.7f, 1e-5f);
}

TEST_F(SpriteTest, theSunLightsASpriteThatDoesNotShadeItselfLikeTheMeanOfABall)
{
    const float exposure = render::exposureFromEv100(kEv100);
    view_->settings().lighting.sunIlluminance = glm::vec3(1.0f / exposure);
    view_->settings().lighting.groundAlbedo = 0.0f;
    for (const auto blend : {base::ParticleBlend::Additive, base::ParticleBlend::Opaque}) {
        clearPicture();
        auto snapshot = emptySnapshot();
        auto& group = addParticles(snapshot, {{{0, 0, 0}, 1.0f}});
        set(group, constant::Texture, white_);
        set(group, constant::Luminance, 0.0f);
        set(group, constant::Lit, 1.0f);
        set(group, constant::Blend, float(blend));
        EXPECT_NEAR(draw(snapshot).at(50, 50)[0], 0.25 / std::numbers::pi, 1e-5) << int(blend);
    }
}

TEST_F(SpriteTest, theBareSpotFadesToItsEdge)
{
    auto snapshot = emptySnapshot();
    addParticles(snapshot, {{{0, 0, 0}, 2.0f}});
    const Picture picture = draw(snapshot);
    const auto expected = [](float x, float y) {
        const float inside = std::max(1.0f - (x * x + y * y) / 4.0f, 0.0f);
        return inside * inside;
    };
    for (const int x : {50, 55, 62, 69, 71})
        EXPECT_NEAR(picture.at(x, 53)[0], expected((float(x) - 49.5f) / 10.0f, 0.35f), 1e-5f) << x;
}

TEST_F(SpriteTest, whatIsSmallerThanAPixelKeepsItsLight)
{
    auto snapshot = emptySnapshot();
    auto& group = addParticles(snapshot, {{{0.313f, 0.271f, 0.0f}, 0.01f}}); // a fifth of a pixel wide
    set(group, constant::Texture, white_);
    set(group, constant::Blend, float(base::ParticleBlend::Additive));
    const Picture picture = draw(snapshot);
    double sum = 0.0;
    for (size_t i = 0; i < picture.texels.size(); i += 4)
        sum += double(picture.texels[i]);
    EXPECT_NEAR(sum, 0.2 * 0.2, 0.2 * 0.2 * 2.0 / 4096.0) << "the radius is rounded to 12 bits";
}
