// Particles between two snapshots, textures with frames, and what reaches the GPU.
#include "particle_fixture.h"

#include <cmath>

using namespace fx;
using namespace fx::test;
namespace constant = base::particle_constant;
namespace column = base::particle_column;

namespace {

constexpr int kSide = 100; ///< [pixel] 10 a metre with flatCamera()

class ParticleMotionTest : public ParticleTest
{
protected:
    void SetUp() override
    {
        ParticleTest::SetUp();
        makeTargets(kSide, kSide);
        const std::vector<uint8_t> texel{255, 255, 255, 255};
        white_ = float(*assets_.addImage(1, 1, true, texel));
    }
    Picture draw(const base::FrameSnapshot& newer, const base::FrameSnapshot* older, double t)
    {
        setPicture(std::vector<float>(size_t(kSide) * kSide * 4, 0.0f));
        return renderPair(newer, older, t, flatCamera());
    }
    base::FrameSnapshot one(double seconds, const TestParticle& p,
                            base::ColumnSet columns = base::kAllColumns)
    {
        auto snapshot = emptySnapshot(seconds);
        set(addParticles(snapshot, {p}, columns), constant::Texture, white_);
        return snapshot;
    }
    /// Mean place and sum of what is lit.
    static glm::vec3 centroid(const Picture& picture)
    {
        glm::vec3 sum(0.0f);
        for (int y = 0; y < kSide; ++y)
            for (int x = 0; x < kSide; ++x)
                sum += picture.at(x, y)[0] * glm::vec3(float(x) + 0.5f, float(y) + 0.5f, 1.0f);
        return {sum.x / sum.z, sum.y / sum.z, sum.z};
    }
    float white_ = 0.0f;
};

} // namespace

TEST_F(ParticleMotionTest, aRowThatLivesInBothIsMixedOfBoth)
{
    TestParticle before{{-2, 0, 0}, 0.4f, {1, 0, 0, 1}, 1.0f};
    TestParticle after{{2, 2, 0}, 0.8f, {0, 1, 0, 1}, 1.5f};
    const auto older = one(1.0, before);
    const auto newer = one(1.5, after);
    const Picture picture = draw(newer, &older, 0.25);
    const float* texel = picture.at(50 - 10, 50 + 5);
    EXPECT_NEAR(texel[0], 0.75f, 1e-3f);
    EXPECT_NEAR(texel[1], 0.25f, 1e-3f);
    EXPECT_NEAR(centroid(picture).z, 100 * 0.75, 1.0) << "a square of 1 m";
}

TEST_F(ParticleMotionTest, aNewcomerInAnOldRowDoesNotStreak)
{
    const auto older = one(1.0, {{-4, 0, 0}, 0.4f, {1, 1, 1, 1}, 7.0f});
    TestParticle born{{2, 0, 0}, 0.4f, {1, 1, 1, 1}, 0.3f, {2.0f, 0.0f, 0.0f}};
    const auto newer = one(1.5, born);
    EXPECT_NEAR(centroid(draw(newer, &older, 1.0)).x, 70.0f, 0.01f);
    EXPECT_NEAR(centroid(draw(newer, &older, 0.5)).x, 65.0f, 0.01f) << "carried back along its velocity";
    const Picture unborn = draw(newer, &older, 0.25); // 0.375 s before the newer: not yet there
    EXPECT_EQ(*std::max_element(unborn.texels.begin(), unborn.texels.end()), 0.0f);
}

TEST_F(ParticleMotionTest, anOldAgeInARowThatWasTakenOverDoesNotJoinThem)
{
    const auto older = one(1.0, {{-4, 0, 0}, 0.4f, {1, 1, 1, 1}, 7.0f});
    const auto newer = one(1.5, {{2, 0, 0}, 0.4f, {1, 1, 1, 1}, 0.5f}); // born at the older's moment
    EXPECT_NEAR(centroid(draw(newer, &older, 0.5)).x, 70.0f, 0.01f);
}

TEST_F(ParticleMotionTest, rowsThatOnlyTheNewerHasAndRowsThatOnlyTheOlderHas)
{
    const auto older = one(1.0, {{-4, 0, 0}, 0.0f, {1, 1, 1, 1}, 7.0f});
    auto newer = emptySnapshot(1.5);
    set(addParticles(newer, {{{0, 0, 0}, 0.0f}, {{2, 0, 0}, 0.4f, {1, 1, 1, 1}, 9.0f}}), constant::Texture,
        white_);
    EXPECT_NEAR(centroid(draw(newer, &older, 0.5)).x, 70.0f, 0.01f);
}

TEST_F(ParticleMotionTest, aMovingInstanceCarriesItsParticles)
{
    auto older = one(1.0, {{0, 0, 0}, 0.4f, {1, 1, 1, 1}, 7.0f});
    auto newer = emptySnapshot(1.5);
    auto& group = addParticles(newer, {{{2, 0, 0}, 0.4f, {1, 1, 1, 1}, 7.5f}});
    set(group, constant::Texture, white_);
    group.editInfo().placement.position = {0.0, 2.0, 0.0};
    group.editInfo().placement.scale = 2.0f;
    const glm::vec3 middle = centroid(draw(newer, &older, 0.5));
    EXPECT_NEAR(middle.x, 50 + 10 * 1.0 * 1.5, 0.05);
    EXPECT_NEAR(middle.y, 60.0f, 0.05f);
}

TEST_F(ParticleMotionTest, columnsThatAreNotThereAreNotNeeded)
{
    const auto older = one(1.0, {{-2, 0, 0}, 0.4f, {1, 1, 1, 1}, 1.0f}, column::kAlways);
    const auto newer = one(1.5, {{2, 0, 0}, 0.4f, {1, 1, 1, 1}, 1.5f}, column::kAlways);
    EXPECT_NEAR(centroid(draw(newer, &older, 0.5)).x, 50.0f, 0.01f);
}

TEST_F(ParticleMotionTest, aFrameUploadsOneStateOfTwentyFourBytesARow)
{
    std::vector<TestParticle> many(1000);
    std::vector<base::FrameSnapshot> states;
    for (int i = 0; i < 8; ++i) {
        many[7].center.x = float(i);
        states.push_back(emptySnapshot(1.0 + 0.5 * i));
        addParticles(states.back(), many, column::kAlways);
    }
    const auto uploaded = [&](size_t newer, double share) {
        (void)draw(states[newer], &states[newer - 1], share);
        return view_->statistics().uploadedBytes;
    };
    EXPECT_EQ(uploaded(1, 0.25), 24'000u) << "mixed of both";
    EXPECT_EQ(uploaded(3, 0.25), 24'000u) << "every second is left out";
    EXPECT_EQ(uploaded(5, 0.25), 24'000u);
    EXPECT_EQ(uploaded(6, 0.5), 24'000u) << "as many frames as snapshots";
    EXPECT_EQ(uploaded(6, 0.75), 48'000u) << "more frames than snapshots: both are kept from now on";
    EXPECT_EQ(uploaded(6, 1.0), 0u);
    EXPECT_EQ(uploaded(7, 0.25), 24'000u);
    EXPECT_EQ(uploaded(7, 0.5), 0u);
    EXPECT_EQ(view_->statistics().particles, 1000u);
    EXPECT_EQ(view_->statistics().programsCompiled, 0u);
}

TEST_F(ParticleMotionTest, whatIsNotSeenIsNotUploadedUntilItIs)
{
    auto snapshot = emptySnapshot(1.0);
    addParticles(snapshot, std::vector<TestParticle>(100), column::kAlways);
    auto& aside = addParticles(snapshot, std::vector<TestParticle>(1000), column::kAlways);
    aside.editInfo().placement.position = {1000.0, 0.0, 0.0};
    aside.editInfo().bounds = {{-1, -1, -1}, {1, 1, 1}};
    (void)draw(snapshot, nullptr, 1.0);
    EXPECT_EQ(view_->statistics().uploadedBytes, 2'400u);
    (void)renderPair(snapshot, nullptr, 1.0,
                     render::orthographicView({{1000, 0, 10}, {1000, 0, 0}}, 4000.0f, 1.0f, 0.1f, 100.0f));
    EXPECT_EQ(view_->statistics().uploadedBytes, 24'000u) << "the others are there";
}

TEST_F(ParticleMotionTest, onlyLivingRowsAreOrderedAndUploaded)
{
    std::vector<TestParticle> many(100);
    for (size_t i = 0; i < 100; i += 4)
        many[i].radius = 0.0f;
    auto snapshot = emptySnapshot(1.0);
    set(addParticles(snapshot, many, column::kAlways), constant::Order, float(base::ParticleOrder::Depth));
    (void)draw(snapshot, nullptr, 1.0);
    EXPECT_EQ(view_->statistics().particlesOrdered, 75u);
    EXPECT_EQ(view_->statistics().uploadedBytes, 2400u + 75u * 4u);
}

TEST_F(ParticleMotionTest, framesOfAnAtlasDoNotBleedIntoEachOther)
{
    std::vector<uint8_t> rgba; // 2 x 2 frames of 8 x 8 texels: red, green, blue, white
    for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 16; ++x) {
            const int frame = y / 8 * 2 + x / 8;
            rgba.insert(rgba.end(),
                        {uint8_t(frame % 3 == 0 ? 255 : 0), uint8_t(frame == 1 || frame == 3 ? 255 : 0),
                         uint8_t(frame >= 2 ? 255 : 0), 255});
        }
    const auto id = float(*assets_.addImage(16, 16, true, rgba));
    const glm::vec3 colors[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}};
    for (const float radius : {3.0f, 0.3f, 0.12f}) // magnified, small, a few pixels
        for (int frame = 0; frame < 4; ++frame) {
            auto snapshot = emptySnapshot();
            TestParticle p{{0.05f, 0.05f, 0.0f}, radius};
            p.frame = float(frame) + 0.4f;
            auto& group = addParticles(snapshot, {p});
            set(group, constant::Texture, id);
            set(group, constant::TileColumns, 2.0f);
            set(group, constant::TileRows, 2.0f);
            const Picture picture = draw(snapshot, nullptr, 1.0);
            for (size_t i = 0; i < picture.texels.size(); i += 4) {
                const float alpha = picture.texels[i + 3];
                for (size_t k = 0; k < 3; ++k)
                    ASSERT_NEAR(picture.texels[i + k], alpha * colors[frame][int(k)], 1e-3f)
                        << radius << " " << frame;
            }
        }
}

TEST_F(ParticleMotionTest, neighboringFramesAreMixedAndTheLastIsFollowedByTheFirst)
{
    std::vector<uint8_t> rgba{255, 0, 0, 255, 0, 255, 0, 255};
    const auto id = float(*assets_.addImage(2, 1, true, rgba));
    for (const bool mixes : {false, true}) {
        auto snapshot = emptySnapshot();
        TestParticle p;
        p.frame = 1.25f;
        auto& group = addParticles(snapshot, {p});
        set(group, constant::Texture, id);
        set(group, constant::TileColumns, 2.0f);
        set(group, constant::FrameBlend, mixes ? 1.0f : 0.0f);
        const Picture picture = draw(snapshot, nullptr, 1.0);
        EXPECT_NEAR(picture.at(50, 50)[0], mixes ? 0.25f : 0.0f, 1e-3f);
        EXPECT_NEAR(picture.at(50, 50)[1], mixes ? 0.75f : 1.0f, 1e-3f);
    }
}

TEST_F(ParticleMotionTest, motionVectorsMoveASpotInsteadOfFadingIt)
{
    // a spot 4 texels wide that is 8 texels farther right and 4 lower in the second frame of 32 texels
    const int side = 32;
    std::vector<uint8_t> color(size_t(side) * side * 2 * 4, 0);
    std::vector<uint8_t> motion;
    const auto spot = [&](int frame, int x0, int y0) {
        for (int y = y0; y < y0 + 4; ++y)
            for (int x = x0; x < x0 + 4; ++x)
                for (size_t k = 0; k < 4; ++k)
                    color[(size_t(y) * 2 * side + size_t(frame * side + x)) * 4 + k] = 255;
    };
    spot(0, 10, 10);
    spot(1, 18, 14);
    for (int i = 0; i < side * 2 * side;
         ++i) // 8 / 32 of the frame right and 4 / 32 down, at a scale of one half
        motion.insert(motion.end(), {uint8_t(std::lround(128 + 0.5 * 127.5)),
                                     uint8_t(std::lround(128 + 0.25 * 127.5)), 0, 255});
    auto snapshot = emptySnapshot();
    TestParticle p;
    p.radius = 5.0f;
    p.frame = 0.5f;
    auto& group = addParticles(snapshot, {p});
    set(group, constant::Texture, float(*assets_.addImage(2 * side, side, true, color)));
    set(group, constant::Motion, float(*assets_.addImage(2 * side, side, false, motion)));
    set(group, constant::MotionScale, 0.5f);
    set(group, constant::TileColumns, 2.0f);
    set(group, constant::FrameBlend, 1.0f);
    const Picture picture = draw(snapshot, nullptr, 1.0);
    const glm::vec3 middle = centroid(picture); // half way: texel 16, 14 from the upper left
    EXPECT_NEAR(middle.x, 100.0 * 16 / 32, 0.5);
    EXPECT_NEAR(middle.y, 100.0 - 100.0 * 14 / 32, 0.5);
    EXPECT_GT(picture.at(50, 56)[0], 0.95f) << "as bright as ever";
}
