// Predicted errors of tiles of blocks, and the choice of tiles by them.
#include "foundation/random/philox.h"
#include "foundation/snapshot/blob_kind.h"
#include "foundation/snapshot/block_kind.h"
#include "rendering/blocks/block_error.h"
#include "simulation/blocks/blocks_def.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include <bit>
#include <cmath>
#include <cstring>
#include <numbers>

using namespace fx;

namespace {

/// Balls in a ball of radius 1 m, with a mean optical depth of 2 together.
std::vector<render::BlockBall> heapOfBalls(uint32_t count, float radius, bool isColored = false)
{
    std::vector<render::BlockBall> balls;
    for (uint32_t i = 0; i < count; ++i) {
        const auto u = base::randomUnit4(3, 0, i, base::RandomPurpose::Position);
        const float z = 2.0f * u[0] - 1.0f, turn = 2.0f * std::numbers::pi_v<float> * u[1];
        const float flat = std::sqrt(std::max(1.0f - z * z, 0.0f)), away = (1.0f - radius) * std::cbrt(u[2]);
        const glm::vec3 color = isColored ? glm::vec3(u[3], 1.0f - u[3], 0.5f) : glm::vec3(1.0f, 0.7f, 0.4f);
        balls.push_back({{away * flat * std::cos(turn), away * flat * std::sin(turn), away * z, radius},
                         {0.0f, 0.0f, 0.0f, 2.0f * std::numbers::pi_v<float> / float(count)},
                         {color, 0.0f}});
    }
    return balls;
}

render::TileError errorOf(std::span<const render::BlockBall> balls, float density = 1.0f,
                          bool isColored = false)
{
    return render::errorAt(render::predictTileErrors(balls, 1.0f, isColored), density);
}

/// An effect of one block of each type.
class PublishedBlocks
{
public:
    PublishedBlocks(size_t types, uint32_t balls) : snapshot_(&schema_, std::pmr::get_default_resource())
    {
        for (const base::KindDesc* kind : {&base::kBlobKind, &base::kBlockKind, &base::kBlockBallKind})
            schema_.add(*kind);
        sim::BlocksDef def;
        for (size_t type = 0; type < types; ++type) {
            sim::BlockType heap;
            heap.name = "heap";
            for (const render::BlockBall& ball : heapOfBalls(balls + uint32_t(type), 0.3f))
                heap.balls.push_back({.center = glm::vec3(ball.place),
                                      .radius = ball.place.w,
                                      .crossSection = ball.medium.w,
                                      .emission = glm::vec3(1.0f)});
            def.types.push_back(heap);
            def.blocks.emplace_back();
            def.blocks.back().type = uint32_t(type);
        }
        EXPECT_TRUE(sim::completeTypes(def.types).ok());
        snapshot_.begin(0, 1);
        def.create(schema_, {}, std::pmr::get_default_resource())->publish({}, snapshot_);
        groups_.emplace(snapshot_, snapshot_.addedCount() - 1);
        contents.build(*groups_);
    }

private:
    base::SnapshotSchema schema_;
    base::FrameSnapshot snapshot_;
    std::optional<base::BlockGroups> groups_;

public:
    render::BlockContents contents{std::pmr::get_default_resource()};
};

} // namespace

TEST(TileErrorPrediction, fallsWithTheSquareOfATexel)
{
    const render::TileError error = errorOf(heapOfBalls(40, 0.35f));
    for (size_t size = 1; size < render::kTileSizes; ++size)
        EXPECT_LE(error.texels[size].rms, 0.45f * error.texels[size - 1].rms) << size;
    EXPECT_NEAR(std::log2(error.texels[2].rms / error.texels[3].rms), 2.0f, 0.7f);
    EXPECT_GT(error.texels[3].rms, 0.0f);
}

TEST(TileErrorPrediction, isLargerWhereBallsAreSmall)
{
    const render::TileError soft = errorOf(heapOfBalls(40, 0.5f)), fine = errorOf(heapOfBalls(40, 0.2f));
    EXPECT_GE(fine.shift.rms, 2.0f * soft.shift.rms);
    for (size_t size = 0; size < render::kTileSizes; ++size)
        EXPECT_GE(fine.texels[size].rms, 2.0f * soft.texels[size].rms);
}

TEST(TileErrorPrediction, ofOneBallInTheMiddleIsNotOneOfDirections)
{
    const render::BlockBall ball{
        {0.0f, 0.0f, 0.0f, 1.0f}, {0.0f, 0.0f, 0.0f, 2.0f}, {1.0f, 1.0f, 1.0f, 0.0f}};
    const render::TileError error = errorOf({&ball, 1});
    EXPECT_LE(error.shift.rms, 1e-4f);
    EXPECT_LE(error.texels[1].rms, 1e-3f);
}

TEST(TileErrorPrediction, ofColorsIsThatOfBallsThatDiffer)
{
    EXPECT_EQ(errorOf(heapOfBalls(30, 0.3f)).light.rms, 0.0f);
    const std::vector<render::BlockBall> colored = heapOfBalls(30, 0.3f, true);
    const float dense = errorOf(colored, 16.0f, true).light.rms,
                thin = errorOf(colored, 0.1f, true).light.rms;
    EXPECT_GT(dense, 2.0f * thin); // in thin content the order of colors is not seen
    EXPECT_EQ(errorOf(colored, 1.0f, true).albedo.rms, 0.0f);
}

TEST(TileErrorPrediction, isContinuousInTheDensity)
{
    const render::TileErrors errors = render::predictTileErrors(heapOfBalls(30, 0.3f), 1.0f, false);
    float last = render::errorAt(errors, std::exp2(-8.01f)).texels[0].rms;
    for (float power = -8.0f; power <= 6.0f; power += 0.01f) {
        const float now = render::errorAt(errors, std::exp2(power)).texels[0].rms;
        EXPECT_NEAR(now, last, 0.02f * std::max(now, 0.01f)) << power;
        last = now;
    }
    EXPECT_LE(render::errorAt(errors, 0.0f).shift.rms, 1e-12f);
}

TEST(TileErrorPrediction, isTheSameEachTimeAndBounded)
{
    const std::vector<render::BlockBall> balls = heapOfBalls(render::kMaxTileBalls, 0.02f);
    const render::TileErrors first = render::predictTileErrors(balls, 1.0f, false);
    const render::TileErrors second = render::predictTileErrors(balls, 1.0f, false);
    EXPECT_EQ(std::memcmp(&first, &second, sizeof first), 0);
    EXPECT_GT(errorOf(balls).texels[0].rms, 0.0f);
}

TEST(TileChoices, areTheCoarsestWithinTheLimit)
{
    render::TileError error;
    error.texels = {{{0.04f, 0.04f}, {0.01f, 0.01f}, {0.0025f, 0.0025f}, {0.0006f, 0.0006f}}};
    error.shift = {0.5f, 0.5f};
    const render::TileSource source{1.0f, 1.0f};
    int last = 0;
    float lastAngle = 1e9f;
    for (const float limit : {0.1f, 0.02f, 0.005f}) {
        const render::TileChoice choice = render::chooseTile(error, source, {}, limit);
        EXPECT_LE(choice.least, limit);
        EXPECT_GT(choice.texels, last);
        EXPECT_LT(choice.angle, lastAngle);
        const auto size = size_t(std::countr_zero(uint32_t(choice.texels / render::kMinTile)));
        EXPECT_LE(std::hypot(error.texels[size].rms, error.shift.rms * choice.angle), limit);
        if (size > 0) {
            EXPECT_GT(2.0f * error.texels[size - 1].rms, limit);
        }
        last = choice.texels;
        lastAngle = choice.angle;
    }
    EXPECT_GT(render::chooseTile(error, source, {}, 5e-4f).least, 5e-4f);
    // What is half as bright errs by half as much, and near blocks have wider texels.
    EXPECT_LT(render::chooseTile(error, {1.0f, 0.5f}, {}, 0.1f).least,
              0.6f * render::chooseTile(error, source, {}, 0.1f).least);
    EXPECT_GT(render::chooseTile(error, source, {96.0f, 0.5f}, 0.1f).least,
              1.2f * render::chooseTile(error, source, {}, 0.1f).least);
    // Few pixels may be those of the largest errors.
    EXPECT_GT(render::chooseTile(error, source, {6.0f, 0.0f}, 0.1f).least,
              1.1f * render::chooseTile(error, source, {}, 0.1f).least);
    error.light = {0.01f, 0.01f};
    EXPECT_GE(render::chooseTile(error, {2.0f, 1.0f}, {}, 0.1f).least, 0.02f);
}

TEST(BlockErrorCache, predictsOnceAndLeavesMuchWorkToLaterFrames)
{
    const PublishedBlocks blocks(8, 6000);
    render::BlockErrors errors(std::pmr::get_default_resource());
    size_t known = 0, frames = 0;
    for (; known < 8 && frames < 8; ++frames) {
        errors.begin(true);
        known = 0;
        for (uint32_t type = 0; type < 8; ++type)
            known += errors.find(base::variantOf(type, 0), blocks.contents, 0.0) ? 1 : 0;
        EXPECT_EQ(errors.deferred(), 8 - known);
        EXPECT_LE(known, 3 * (frames + 1));
    }
    EXPECT_EQ(known, 8u);
    EXPECT_GE(frames, 2u);
    errors.begin(true);
    const render::TileErrors* const again = errors.find(base::variantOf(0, 0), blocks.contents, 5.0);
    ASSERT_TRUE(again);
    EXPECT_EQ(errors.find(base::variantOf(0, 0), blocks.contents, 9.0), again);
    render::BlockErrors atOnce(std::pmr::get_default_resource());
    atOnce.begin(false);
    for (uint32_t type = 0; type < 8; ++type)
        EXPECT_TRUE(atOnce.find(base::variantOf(type, 0), blocks.contents, 0.0));
}
