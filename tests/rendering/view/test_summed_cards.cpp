// Sprites and ribbons in the compositions that sum media up, alone and among balls.
#include "particle_fixture.h"
#include "tests/rendering/view/permutations.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>

using namespace fx;
using namespace fx::test;
namespace constant = base::particle_constant;

namespace {

constexpr int kSide = 32;

class SummedCards : public ParticleTest, public testing::WithParamInterface<render::Composition>
{
protected:
    void SetUp() override
    {
        ParticleTest::SetUp();
        makeTargets(kSide, kSide);
        white_ = float(*assets_.addImage(1, 1, true, std::vector<uint8_t>{255, 255, 255, 255}));
    }
    Picture draw(const base::FrameSnapshot& snapshot) { return draw(snapshot, GetParam()); }
    Picture draw(const base::FrameSnapshot& snapshot, render::Composition composition)
    {
        view_->settings().composition = composition;
        setPicture(std::vector<float>(size_t(color_->width()) * size_t(color_->height()) * 4, 0.25f));
        return renderPair(snapshot, nullptr, 1.0, flatCamera());
    }
    base::FrameSnapshot card(const glm::vec4& color, base::ParticleBlend blend)
    {
        auto snapshot = emptySnapshot();
        set(addParticles(snapshot, {{{0, 0, 1}, 3.0f, color}}), constant::Blend, float(blend));
        return snapshot;
    }
    double difference(const base::FrameSnapshot& snapshot)
    {
        return maxDifference(draw(snapshot), draw(snapshot, render::Composition::Sorted));
    }
    /// Balls, sprites and ribbons that overlap; in another order for each seed but 0.
    base::FrameSnapshot mixture(uint32_t seed);
    float white_ = 0.0f;
};

base::FrameSnapshot SummedCards::mixture(uint32_t seed)
{
    std::mt19937 random(3), order(seed);
    std::uniform_real_distribution<float> side(-3.0f, 3.0f), share(0.0f, 1.0f);
    std::vector<TestBlob> blobs;
    std::vector<TestParticle> sprites;
    std::vector<std::vector<TestPoint>> ribbons;
    for (int i = 0; i < 100; ++i) {
        const auto place = [&] { return glm::vec3(side(random), side(random), side(random)); };
        blobs.push_back({place(), 1.2f, 0.5f, share(random)});
        const glm::vec3 gray(share(random));
        sprites.push_back({place(), 0.8f, glm::vec4(gray, share(random))});
        if (i % 10 == 0)
            ribbons.push_back({{place(), 0.3f, 0.0f, glm::vec4(gray, 0.6f)},
                               {place(), 0.3f, 1.0f, glm::vec4(gray, 0.6f)},
                               {place(), 0.3f, 2.0f, glm::vec4(gray, 0.6f)}});
    }
    if (seed > 0) {
        std::shuffle(blobs.begin(), blobs.end(), order);
        std::shuffle(sprites.begin(), sprites.end(), order);
        std::shuffle(ribbons.begin(), ribbons.end(), order);
    }
    auto snapshot = snapshotOf(blobs);
    for (const auto& ribbon : ribbons)
        addRibbon(snapshot, ribbon);
    set(addParticles(snapshot, sprites), constant::Softness, 0.2f);
    return snapshot;
}

} // namespace

TEST_P(SummedCards, aSpriteThatStandsAloneCoversByItsOpacity)
{
    for (const float alpha : {0.05f, 0.5f, 0.99f})
        EXPECT_LT(difference(card({0.8f, 0.4f, 0.1f, alpha}, base::ParticleBlend::Alpha)), 1e-3) << alpha;
}

TEST_P(SummedCards, whatAddsEmitsAndHidesNothing)
{
    const auto snapshot = card({0.8f, 0.4f, 0.1f, 0.5f}, base::ParticleBlend::Additive);
    EXPECT_LT(difference(snapshot), 1e-5);
    EXPECT_GT(draw(snapshot).at(16, 16)[0], 0.3f);
}

TEST_P(SummedCards, whatIsOpaqueHides)
{
    EXPECT_EQ(difference(card({0.8f, 0.4f, 0.1f, 1.0f}, base::ParticleBlend::Opaque)), 0.0);
}

TEST_P(SummedCards, aSpriteBetweenTwoBallsIsCoveredByTheNearerOnly)
{
    const auto light = [&](float z) {
        auto snapshot = snapshotOf({{{0, 0, 2}, 1.5f, 3.0f}, {{0, 0, -2}, 1.5f, 3.0f}});
        set(addParticles(snapshot, {{{0, 0, z}, 1.5f, glm::vec4(1.0f, 1.0f, 1.0f, 0.9f)}}), constant::Texture,
            white_);
        setPicture(std::vector<float>(size_t(kSide) * kSide * 4, 0.0f));
        view_->settings().composition = GetParam();
        return renderPair(snapshot, nullptr, 1.0, flatCamera()).at(16, 16)[0];
    };
    const float before = light(4.0f), between = light(0.0f), behind = light(-4.0f);
    EXPECT_NEAR(before, 0.9f, 1e-3f);
    EXPECT_LT(between, 0.5f);
    EXPECT_NEAR(behind * before, between * between, 2e-3f) << "each ball lets the same share through";
}

TEST_P(SummedCards, noOrderOfBallsSpritesAndRibbonsIsSeen)
{
    makeTargets(16, 16);
    const auto changes = [&](render::Composition composition, int count) {
        const Picture first = draw(mixture(0), composition);
        const float brightest = *std::max_element(first.texels.begin(), first.texels.end());
        double most = 0.0;
        for (int seed = 1; seed <= count; ++seed)
            most = std::max(most, maxDifference(draw(mixture(uint32_t(seed)), composition), first));
        return most / double(brightest);
    };
    const double change = changes(GetParam(), permutations());
    std::printf("%d orders: largest change %.1e of the brightest value\n", permutations(), change);
    EXPECT_LT(change, 1.0 / 1023.0);
    EXPECT_GT(changes(render::Composition::Sorted, 10), 1.0 / 1023.0)
        << "the control: one over the other depends on the order";
}

TEST_P(SummedCards, withLayersThePictureIsTheSame)
{
    const Picture plain = draw(mixture(0));
    view_->settings().layerOutputs = true;
    const Picture layered = draw(mixture(0));
    const bool hasHalves = GetParam() == render::Composition::Volume; // fields keep layers as halves
    EXPECT_LT(maxDifference(plain, layered), hasHalves ? 4e-3 : 2e-4);
    const render::LayerTextures layers = view_->layers();
    const Picture fire = read(layers.fire), smoke = read(layers.smoke), dust = read(layers.dust);
    const Picture media = read(layers.media);
    for (size_t i = 0; i < media.texels.size(); ++i)
        ASSERT_NEAR(fire.texels[i] + smoke.texels[i] + dust.texels[i], media.texels[i], 1e-5f);
}

TEST_P(SummedCards, fragmentsBeyondTheListsAreCounted)
{
    auto snapshot = emptySnapshot();
    std::vector<TestParticle> many(3000, {{0, 0, 0}, 20.0f, glm::vec4(1.0f, 1.0f, 1.0f, 0.01f)});
    addParticles(snapshot, many); // 3000 times 1024 texels: more than 2^21
    view_->settings().countOverdraw = true;
    draw(snapshot);
    EXPECT_GT(view_->statistics().spilledCards, 0u);
    EXPECT_LT(view_->statistics().spilledCards, uint64_t(3000) * kSide * kSide);
    many.resize(10);
    auto few = emptySnapshot();
    addParticles(few, many);
    draw(few);
    EXPECT_EQ(view_->statistics().spilledCards, 0u);
}

INSTANTIATE_TEST_SUITE_P(Compositions, SummedCards,
                         testing::Values(render::Composition::Slabs, render::Composition::Volume),
                         [](const auto& one) {
                             return one.param == render::Composition::Slabs ? "Slabs" : "Volume";
                         });
