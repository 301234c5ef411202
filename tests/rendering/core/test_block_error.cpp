// Predicted errors of tiles of blocks, and the choice of tiles by them.
#include "foundation/random/philox.h"
#include "foundation/snapshot/blob_kind.h"
#include "foundation/snapshot/block_kind.h"
#include "rendering/blocks/block_walk.h"
#include "simulation/blocks/blocks_def.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include <algorithm>
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
        balls.push_back(
            {{away * flat * std::cos(turn), away * flat * std::sin(turn), away * z, radius},
             {isColored ? 1.0f - color : glm::vec3(0.9f), 2.0f * std::numbers::pi_v<float> / float(count)},
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
    /// @param radius [m] of the balls  @param places [m] of blocks of the first type, beyond one of each
    PublishedBlocks(size_t types, uint32_t balls, float radius = 0.3f,
                    const std::vector<glm::vec3>& places = {})
        : snapshot_(&schema_, std::pmr::get_default_resource())
    {
        for (const base::KindDesc* kind : {&base::kBlobKind, &base::kBlockKind, &base::kBlockBallKind})
            schema_.add(*kind);
        sim::BlocksDef def;
        for (size_t type = 0; type < types; ++type) {
            sim::BlockType heap;
            heap.name = "heap";
            for (const render::BlockBall& ball : heapOfBalls(balls + uint32_t(type), radius))
                heap.balls.push_back({.center = glm::vec3(ball.place),
                                      .radius = ball.place.w,
                                      .crossSection = ball.medium.w,
                                      .emission = glm::vec3(1.0f)});
            def.types.push_back(heap);
            def.blocks.emplace_back();
            def.blocks.back().type = uint32_t(type);
        }
        for (const glm::vec3& place : places) {
            def.blocks.emplace_back();
            def.blocks.back().position = place;
        }
        EXPECT_TRUE(sim::completeTypes(def.types).ok());
        snapshot_.begin(0, 1);
        def.create(schema_, {}, std::pmr::get_default_resource())->publish({}, snapshot_);
        groups_.emplace(snapshot_, snapshot_.addedCount() - 1);
        contents.build(*groups_);
    }

    /// Makes the content such as may change with time.
    void animate()
    {
        for (size_t i = 0; i < snapshot_.addedCount(); ++i)
            if (snapshot_.added(i).info().kind == schema_.find(base::kBlockBallKind.name))
                std::ranges::fill(snapshot_.editGroup(i).editColumn(base::blob_column::Age), 1.0f);
        contents.build(*groups_);
    }

    /// What an eye at the origin draws that looks along -z. @param place [m] of the effect
    std::pmr::vector<render::GatheredBlob> walk(const glm::dvec3& place, uint32_t maxBalls,
                                                bool isSpread = false, uint32_t maxCasters = 65536)
    {
        render::CameraGeometry camera{};
        camera.right = {1, 0, 0};
        camera.up = {0, 1, 0};
        camera.forward = {0, 0, -1};
        camera.nearDistance = 1e-3f;
        camera.clipScale = glm::vec2(2.4f);
        std::pmr::vector<render::GatheredBlob> balls;
        std::pmr::vector<render::BlockRecord> records;
        casters.clear();
        tiles_.begin({});
        errors_.begin(isSpread);
        render::BlockWalk walk(camera, 1080, tiles_, balls, casters, records);
        render::BlockWalkSettings settings;
        settings.error = 1.0f / 255.0f;
        settings.errors = &errors_;
        settings.maxBalls = maxBalls;
        settings.maxCasters = maxCasters;
        base::Placement placement;
        placement.position = place;
        walk.run(*groups_, contents, nullptr, 1.0f, 0.0f, 0.0, placement, {}, {}, settings);
        return balls;
    }

private:
    base::SnapshotSchema schema_;
    base::FrameSnapshot snapshot_;
    std::optional<base::BlockGroups> groups_;
    render::BlockTiles tiles_{std::pmr::get_default_resource()};
    render::BlockErrors errors_{std::pmr::get_default_resource()};

public:
    render::BlockContents contents{std::pmr::get_default_resource()};
    std::pmr::vector<render::MediumCaster> casters; ///< of the last walk
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
    const render::TileError ofOneColor = errorOf(heapOfBalls(30, 0.3f), 1.0f, true);
    const std::vector<render::BlockBall> colored = heapOfBalls(30, 0.3f, true);
    const float dense = errorOf(colored, 16.0f, true).light.rms,
                thin = errorOf(colored, 0.1f, true).light.rms;
    EXPECT_GT(dense, 2.0f * thin); // in thin content the order of colors is not seen
    const render::TileError error = errorOf(colored, 1.0f, true);
    EXPECT_GT(error.light.rms, 1e-3f);
    EXPECT_GT(error.albedo.rms, 1e-3f);
    EXPECT_LE(ofOneColor.light.rms, 1e-4f);
    EXPECT_LE(ofOneColor.albedo.rms, 1e-4f);
}

TEST(TileErrorPrediction, meetsBallsThatCoverLittle)
{
    // 20 clumps that cover 3 % of the block, of many balls and of few. Rays over the whole block miss them.
    for (const uint32_t each : {3000u, 3u}) {
        std::vector<render::BlockBall> balls;
        const std::vector<render::BlockBall> places = heapOfBalls(20, 0.04f), clump = heapOfBalls(each, 0.3f);
        for (const render::BlockBall& place : places)
            for (render::BlockBall ball : clump) {
                ball.place = glm::vec4(glm::vec3(place.place) + 0.04f * glm::vec3(ball.place), 0.04f * 0.3f);
                ball.medium.w *= 0.04f * 0.04f;
                balls.push_back(ball);
            }
        const render::TileError error = errorOf(balls);
        EXPECT_GE(error.rays, 32.0f) << each;
        EXPECT_LE(error.covered, 0.06f) << each;
        EXPECT_GE(error.covered, 0.002f) << each;
        EXPECT_GE(error.texels[0].rms, 0.1f) << each; // a clump is smaller than a texel
        EXPECT_GT(render::chooseTile(error, {1.0f, 1.0f}, {}, 1.0f / 255.0f).least, 1.0f / 255.0f) << each;
    }
}

TEST(TileErrorPrediction, isThatOfThinAndOfDenseContent)
{
    // Depth and density are one factor, however large either is.
    const std::vector<render::BlockBall> balls = heapOfBalls(30, 0.3f);
    std::vector<render::BlockBall> thin = balls;
    for (render::BlockBall& ball : thin)
        ball.medium.w /= 4096.0f;
    for (const float density : {0.01f, 0.5f, 3.0f, 16.0f}) {
        const render::TileError of = errorOf(balls, density), ofThin = errorOf(thin, 4096.0f * density);
        EXPECT_NEAR(ofThin.shift.rms, of.shift.rms, 1e-3f * of.shift.rms) << density;
        EXPECT_NEAR(ofThin.texels[0].rms, of.texels[0].rms, 1e-3f * of.texels[0].rms) << density;
    }
    // The larger the density, the larger the error at the rim of what is opaque.
    EXPECT_GE(errorOf(balls, 1e6f).texels[0].rms, errorOf(balls, 100.0f).texels[0].rms);
    EXPECT_GE(errorOf(balls, 100.0f).texels[0].rms, errorOf(balls, 1.0f).texels[0].rms);
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
    EXPECT_EQ(std::memcmp(first.ofPowers.data(), second.ofPowers.data(), sizeof first.ofPowers), 0);
    EXPECT_EQ(first.lowest, second.lowest);
    EXPECT_EQ(first.work, second.work);
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
    // Tiles are no finer than they may be, which the error that is left tells.
    const render::TileChoice coarse = render::chooseTile(error, source, {96.0f, 0.0f, 32}, 0.005f);
    EXPECT_EQ(coarse.texels, 32);
    EXPECT_GT(coarse.least, 0.01f);
    error.light = {0.01f, 0.01f};
    EXPECT_GE(render::chooseTile(error, {2.0f, 1.0f}, {}, 0.1f).least, 0.02f);
}

TEST(BlockErrorCache, takesTheWorkOnRaysForWork)
{
    const std::vector<render::BlockBall> few = heapOfBalls(10, 0.3f);
    EXPECT_GE(render::predictTileErrors(few, 1.0f, true).work,
              4 * render::predictTileErrors(few, 1.0f, false).work);
    const PublishedBlocks blocks(64, 10);
    render::BlockErrors errors(std::pmr::get_default_resource());
    errors.begin(true);
    size_t known = 0;
    for (uint32_t type = 0; type < 64; ++type)
        known += errors.find(base::variantOf(type, 0), blocks.contents, 0.0) ? 1 : 0;
    EXPECT_GE(known, 1u);
    EXPECT_LE(known, 8u);
    errors.forget();
    errors.begin(true);
    EXPECT_EQ(errors.find(base::variantOf(63, 0), blocks.contents, 0.0) ? 1 : 0, 1);
}

TEST(BlockErrorCache, newContentComesBeforeAnimatedContentThatIsDue)
{
    PublishedBlocks blocks(8, 6000);
    blocks.animate();
    ASSERT_TRUE(blocks.contents.of(base::variantOf(7, 0)).isAnimated);
    render::BlockErrors errors(std::pmr::get_default_resource());
    size_t known = 0;
    for (int frame = 0; frame < 8; ++frame) {
        errors.begin(true);
        known = 0;
        for (uint32_t type = 0; type < 8; ++type) // all that are known are due in each frame
            known += errors.find(base::variantOf(type, 0), blocks.contents, 0.3 * double(frame)) ? 1 : 0;
        EXPECT_GE(known, std::min<size_t>(size_t(frame) + 1, 8));
    }
    EXPECT_EQ(known, 8u);
    // The one that has waited longest is next, wherever it is in the order: all get their turn.
    uint32_t most = 0;
    for (int frame = 8; frame < 40; ++frame) {
        errors.begin(true);
        for (uint32_t type = 0; type < 8; ++type)
            errors.find(base::variantOf(type, 0), blocks.contents, 0.3 * double(frame));
        most = std::max(most, errors.longestWait());
    }
    EXPECT_LE(most, 16u);
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
        EXPECT_GE(known, frames + 1);
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

namespace {

struct Drawn
{
    uint32_t impostors = 0, near = 0, far = 0; ///< balls nearer than 10 m and farther away
    explicit Drawn(const std::pmr::vector<render::GatheredBlob>& balls)
    {
        for (const render::GatheredBlob& ball : balls)
            ++(ball.tile > 0 ? impostors : glm::length(ball.center) < 10.0f ? near : far);
    }
};

} // namespace

TEST(BlockWalks, nearBlocksGetBallsBeforeFarOnesOfALargeError)
{
    // Impostors of balls that are as small err by too much. The block around the eye is the last one.
    std::vector<glm::vec3> places;
    for (int i = 0; i < 30; ++i)
        places.emplace_back(0.0f, 0.0f, -0.1f * float(i));
    places.emplace_back(0.0f, 0.0f, 119.0f);
    PublishedBlocks blocks(1, 200, 0.05f, places);
    const Drawn all(blocks.walk({0.0, 0.0, -120.0}, 32 * 200)); // none is too many
    EXPECT_EQ(all.impostors, 0u);
    EXPECT_EQ(all.far, 31 * 200u);
    EXPECT_GE(all.near, 50u);
    const Drawn some(blocks.walk({0.0, 0.0, -120.0}, 1200));
    EXPECT_EQ(some.near, all.near);
    EXPECT_GE(some.far, 200u);
    EXPECT_LE(some.near + some.far, 600u); // the rest is for what is near or large
    EXPECT_EQ(some.impostors, 31 - some.far / 200);
    const Drawn few(blocks.walk({0.0, 0.0, -120.0}, 30));
    EXPECT_EQ(few.near, 30u);
    EXPECT_EQ(few.far, 0u);
    EXPECT_EQ(few.impostors, 31u);
}

TEST(BlockWalks, blocksForWhichThereIsNeitherATileNorRoomAreSingleBalls)
{
    std::vector<glm::vec3> places; // each needs a tile of its own, more than the atlas has
    for (int i = 0; i < 13 * 13; ++i)
        places.emplace_back(1.8f * float(i % 13 - 6), 1.8f * float(i / 13 - 6), 0.0f);
    constexpr uint32_t kBalls = 50, kMaxBalls = 120;
    PublishedBlocks effect(1, kBalls, 0.3f, places);
    const auto drawn = effect.walk({0.0, 0.0, -30.0}, kMaxBalls);
    const render::BlockContent& content = effect.contents.of(0);
    double section = 0.0;
    size_t balls = 0, tiles = 0, single = 0;
    for (const render::GatheredBlob& ball : drawn) {
        section += double(ball.crossSection);
        const bool isTile = ball.tile != 0, isBlock = !isTile && ball.radius == content.momentRadius;
        balls += !isTile && !isBlock;
        tiles += isTile;
        single += isBlock;
    }
    const double wanted = double(places.size() + 1) * double(content.crossSection);
    EXPECT_NEAR(section, wanted, 1e-4 * wanted); // no medium is missing
    EXPECT_LE(balls, kMaxBalls);
    EXPECT_GE(tiles, 128u); // pages of the atlas; what is nearly the same shares one
    EXPECT_GT(single, 30u);
}

TEST(BlockWalks, castersOfManyBallsAreWhatIsDrawn)
{
    std::vector<glm::vec3> places;
    for (int i = 0; i < 30; ++i)
        places.emplace_back(0.0f, 0.0f, -0.1f * float(i));
    places.emplace_back(0.0f, 0.0f, 119.0f); // around the eye
    places.emplace_back(0.0f, 0.0f, 240.0f); // behind it
    PublishedBlocks blocks(1, 200, 0.05f, places);
    // Of what is in front of the eye, about the place of the effect: x mass, y first moment along the view, z
    // second moment. That of the kernel about its center is a third of the square of its radius.
    const auto moments = [&] {
        glm::dvec3 sum(0.0);
        for (const render::MediumCaster& caster : blocks.casters) {
            const glm::dvec3 center = glm::dvec3(caster.center) + glm::dvec3(0.0, 0.0, 120.0);
            const auto radius = double(caster.radius);
            if (std::abs(center.z) < 20.0)
                sum += double(caster.crossSection) *
                       glm::dvec3(1.0, center.z, glm::dot(center, center) + radius * radius / 3.0);
        }
        return sum;
    };
    (void)blocks.walk({0.0, 0.0, -120.0}, 100'000);
    const glm::dvec3 ofAll = moments();
    EXPECT_EQ(blocks.casters.size(), 33 * 200u);
    for (const uint32_t most : {0u, 500u, 1200u, 6000u}) {
        const auto balls = blocks.walk({0.0, 0.0, -120.0}, 100'000, false, most);
        for (int k = 0; k < 3; ++k)
            EXPECT_NEAR(moments()[k], ofAll[k], 1e-5 * std::abs(ofAll[k])) << most << ", moment " << k;
        EXPECT_LE(blocks.casters.size(), most + 33u);
        size_t same = 0, drawn = 0;
        for (const render::GatheredBlob& ball : balls) {
            if (ball.tile > 0)
                continue;
            ++drawn;
            same += std::ranges::any_of(blocks.casters, [&](const render::MediumCaster& caster) {
                return caster.center == ball.center; // small balls are widened on the picture
            });
        }
        // The block around the eye is drawn as balls, whatever shadow it casts.
        EXPECT_EQ(same, most == 0 ? 0u : drawn) << most;
    }
}

TEST(BlockWalks, contentIsDrawnUntilItsErrorIsKnown)
{
    PublishedBlocks blocks(8, 6000);
    const Drawn first(blocks.walk({0.0, 0.0, -300.0}, 100'000, true));
    EXPECT_GE(first.impostors, 1u);
    EXPECT_GE(first.far, 6000u);
    EXPECT_LE(first.impostors, 4u);
    for (int frame = 0; frame < 7; ++frame)
        (void)blocks.walk({0.0, 0.0, -300.0}, 100'000, true);
    const Drawn last(blocks.walk({0.0, 0.0, -300.0}, 100'000, true));
    EXPECT_EQ(last.impostors, 8u);
    EXPECT_EQ(last.far, 0u);
}
