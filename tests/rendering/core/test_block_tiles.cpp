// Directions and the cache of tiles of blocks.
#include "rendering/blocks/block_tiles.h"

#include "foundation/random/philox.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

using namespace fx;

namespace {

glm::vec3 randomDirection(uint64_t i)
{
    const auto u = base::randomUnit4(5, 0, i, base::RandomPurpose::Axis);
    const float z = 2.0f * u[0] - 1.0f, turn = 2.0f * std::numbers::pi_v<float> * u[1];
    const float flat = std::sqrt(std::max(1.0f - z * z, 0.0f));
    return {flat * std::cos(turn), flat * std::sin(turn), z};
}

float angleBetween(const glm::vec3& a, const glm::vec3& b)
{
    return 2.0f * std::asin(std::min(0.5f * glm::length(a - b), 1.0f));
}

render::BlockContent contentOf(uint64_t identity, uint32_t balls = 100, float speed = 0.0f)
{
    render::BlockContent content;
    content.identity = identity;
    content.balls = balls;
    content.radius = 1.0f;
    content.speed = speed;
    content.isAnimated = speed > 0.0f;
    return content;
}

class TileCache : public testing::Test
{
protected:
    std::optional<render::Tile> find(const render::BlockContent& content, const glm::vec3& along,
                                     float pixels = 24.0f, double seconds = 0.0)
    {
        return tiles_.find({0, &content, along, pixels, seconds});
    }

    render::BlockTiles tiles_{std::pmr::get_default_resource()};
    render::TileSettings settings_;
};

} // namespace

TEST(TileDirections, everyDirectionIsNearTheMiddleOfItsCell)
{
    for (const int cells : {1, 2, 4, 16, 64, 256}) {
        float largest = 0.0f;
        for (uint64_t i = 0; i < 20'000; ++i) {
            const glm::vec3 direction = randomDirection(i);
            const render::TileAxes axes = render::axesOfCell(render::directionCell(direction, cells), cells);
            largest = std::max(largest, angleBetween(axes.along, direction));
        }
        EXPECT_LE(largest * float(cells), 4.2f) << cells;
        EXPECT_GE(largest * float(cells), 1.0f) << cells;
    }
}

TEST(TileDirections, axesAreOrthonormalAndRightHanded)
{
    for (uint64_t i = 0; i < 500; ++i) {
        const render::TileAxes axes = render::axesOfCell(render::directionCell(randomDirection(i), 32), 32);
        EXPECT_NEAR(glm::dot(axes.right, axes.up), 0.0f, 1e-6f);
        EXPECT_NEAR(glm::length(glm::cross(axes.up, axes.right) - axes.along), 0.0f, 1e-6f);
    }
}

TEST(TileDirections, neighborsAreNearAlsoAcrossTheBorderOfTheMap)
{
    constexpr int kCells = 32;
    for (int y = 0; y < kCells; ++y)
        for (int x = 0; x < kCells; ++x)
            for (const glm::ivec2 step :
                 {glm::ivec2(1, 0), glm::ivec2(-1, 0), glm::ivec2(0, 1), glm::ivec2(0, -1)}) {
                const glm::ivec2 next = render::neighborCell({x, y}, step, kCells);
                EXPECT_LE(angleBetween(render::axesOfCell({x, y}, kCells).along,
                                       render::axesOfCell(next, kCells).along) *
                              float(kCells),
                          6.2f)
                    << x << ' ' << y;
            }
}

TEST(TileDirections, cellsAreAsFineAsTheAngleAsks)
{
    for (const float angle : {0.5f, 0.1f, 0.02f})
        for (uint64_t i = 0; i < 2000; ++i) {
            const glm::vec3 direction = randomDirection(i);
            const int cells = render::cellsForAngle(direction, angle);
            const glm::vec3 middle = render::axesOfCell(render::directionCell(direction, cells), cells).along;
            EXPECT_LE(angleBetween(middle, direction), angle * 1.0001f);
            EXPECT_LE(float(cells), 10.0f / angle);
        }
    EXPECT_EQ(render::cellsForAngle({0, 0, 1}, 0.0f), render::kMaxDirectionCells);
}

TEST_F(TileCache, keepsTilesAndMakesEachOnce)
{
    const render::BlockContent content = contentOf(1);
    tiles_.begin(settings_);
    const auto first = find(content, {0, 0, -1});
    ASSERT_TRUE(first);
    EXPECT_EQ(first->size, 32);
    EXPECT_EQ(tiles_.jobs().size(), 1u);
    find(content, glm::normalize(glm::vec3(0.001f, 0, -1)));
    EXPECT_EQ(tiles_.jobs().size(), 1u);
    tiles_.begin(settings_);
    const auto again = find(content, {0, 0, -1});
    EXPECT_TRUE(tiles_.jobs().empty());
    EXPECT_EQ(again->corner, first->corner);
}

TEST_F(TileCache, isDrawnAgainWhenParallaxExceedsTheThreshold)
{
    const render::BlockContent content = contentOf(1);
    // A block of 24 pixels may be seen from half a pixel / 12 pixels beside the true direction.
    const float allowed = settings_.parallax / 12.0f;
    float largest = 0.0f;
    for (int i = 0; i < 300; ++i) {
        const float turn = 0.01f * float(i);
        const glm::vec3 along(std::sin(turn), 0.1f, -std::cos(turn));
        tiles_.begin(settings_);
        largest = std::max(
            largest, angleBetween(find(content, glm::normalize(along))->axes.along, glm::normalize(along)));
    }
    EXPECT_LE(largest, allowed);
    EXPECT_GE(largest, 0.2f * allowed);
}

TEST_F(TileCache, tilesOfOneFrameDoNotOverlapAndLieInTheAtlas)
{
    tiles_.begin(settings_);
    std::set<std::pair<int, int>> texels; // of 16 x 16
    for (uint64_t i = 0; i < 3000; ++i) {
        const render::BlockContent content = contentOf(i);
        const auto tile = find(content, {0, 0, -1}, i % 25 == 0 ? 60.0f : i % 3 == 0 ? 20.0f : 9.0f);
        ASSERT_TRUE(tile);
        ASSERT_EQ(tile->corner % tile->size, glm::ivec2(0));
        ASSERT_LE(tile->corner.x + tile->size, render::kTilePageColumns * render::kMaxTile);
        ASSERT_LE(tile->corner.y + tile->size, tiles_.pageRows() * render::kMaxTile);
        for (int y = 0; y < tile->size; y += 16)
            for (int x = 0; x < tile->size; x += 16)
                EXPECT_TRUE(texels.insert({tile->corner.x + x, tile->corner.y + y}).second);
    }
}

TEST_F(TileCache, givesNoTileWhenThereIsNoRoomAndReplacesWhatIsUnused)
{
    settings_.isSpread = false;
    tiles_.begin(settings_);
    uint64_t i = 0;
    while (find(contentOf(i), {0, 0, -1}, 100.0f))
        ++i;
    EXPECT_EQ(i, uint64_t(render::kTilePageColumns * render::kMaxTilePageRows));
    EXPECT_FALSE(find(contentOf(1000), {0, 0, -1}, 20.0f)); // of another size
    tiles_.begin(settings_);
    EXPECT_TRUE(find(contentOf(2000), {0, 0, -1}, 100.0f)); // in place of one that is not used
    EXPECT_TRUE(find(contentOf(2001), {0, 0, -1}, 20.0f));
    EXPECT_EQ(tiles_.jobs().size(), 2u);
}

TEST_F(TileCache, whereThereIsNoRoomATileOfAnotherFinenessIsGiven)
{
    settings_.isSpread = false;
    tiles_.begin(settings_);
    const render::BlockContent content = contentOf(1);
    ASSERT_TRUE(find(content, {0, 0, -1}, 100.0f));
    for (uint64_t i = 2; find(contentOf(i), {0, 0, -1}, 100.0f);)
        ++i;
    for (const float pixels : {40.0f, 60.0f})
        EXPECT_TRUE(find(content, {0, 0, -1}, pixels)) << pixels;
    EXPECT_FALSE(find(contentOf(1000), {0, 0, -1}, 60.0f)); // of other content there is none
}

TEST_F(TileCache, hasRoomForATileOfTheFinestSideOfEachBlock)
{
    settings_.isSpread = false;
    int last = 2 * render::kMaxTile;
    for (const uint32_t blocks : {128u, 512u, 2000u, 8192u}) {
        tiles_.begin(settings_);
        for (uint32_t i = 0; i < blocks; ++i)
            tiles_.countBlock();
        tiles_.chooseFinest();
        EXPECT_LT(tiles_.finest(), last) << blocks;
        last = tiles_.finest();
        tiles_.begin(settings_);
        for (uint32_t i = 0; i < blocks; ++i) {
            const render::BlockContent content = contentOf(i);
            render::TileRequest request{0, &content, {0.0f, 0.0f, 1.0f}, 8.0f};
            request.texels = tiles_.finest();
            const auto tile = tiles_.find(request);
            ASSERT_TRUE(tile.has_value()) << i << " of " << blocks;
            ASSERT_EQ(tile->size, tiles_.finest());
        }
    }
    EXPECT_EQ(last, render::kMinTile);
}

TEST_F(TileCache, tilesBecomeFinerAgainWhereThereIsRoomToSpare)
{
    const auto finestOf = [&](uint32_t blocks) {
        tiles_.begin(settings_);
        for (uint32_t i = 0; i < blocks; ++i)
            tiles_.countBlock();
        tiles_.chooseFinest();
        return tiles_.finest();
    };
    EXPECT_EQ(finestOf(128), render::kMaxTile);
    EXPECT_EQ(finestOf(129), render::kMaxTile / 2);
    EXPECT_EQ(finestOf(128), render::kMaxTile / 2); // not in turn
    EXPECT_EQ(finestOf(100), render::kMaxTile);
    EXPECT_EQ(finestOf(1'000'000), render::kMinTile);
    EXPECT_EQ(finestOf(0), render::kMaxTile);
    settings_.isSpread = false; // nothing depends on what was seen before
    EXPECT_EQ(finestOf(129), render::kMaxTile / 2);
    EXPECT_EQ(finestOf(128), render::kMaxTile);
}

TEST_F(TileCache, spreadsOverFramesWhatANeighborCanReplace)
{
    const render::BlockContent content = contentOf(1, 60'000);
    tiles_.begin(settings_);
    for (int i = 0; i < 40; ++i) // whatever it takes: there are no others
        ASSERT_TRUE(find(contentOf(100 + uint64_t(i), 60'000), {0, 0, -1}));
    EXPECT_EQ(tiles_.deferred(), 0u);
    ASSERT_TRUE(find(content, {0, 0, -1}));
    tiles_.begin(settings_);
    for (int i = 0; i < 8; ++i)
        find(contentOf(200 + uint64_t(i), 60'000), {0, 0, -1});
    const size_t jobs = tiles_.jobs().size();
    const glm::vec3 next = glm::normalize(glm::vec3(0.06f, 0.02f, -1.0f));
    ASSERT_TRUE(find(content, next));
    EXPECT_EQ(tiles_.jobs().size(), jobs);
    EXPECT_EQ(tiles_.deferred(), 1u);
    tiles_.begin(settings_);
    ASSERT_TRUE(find(content, next));
    EXPECT_EQ(tiles_.jobs().size(), 1u);
    EXPECT_EQ(tiles_.deferred(), 0u);
}

TEST_F(TileCache, movingContentIsDrawnAgainWhenItHasMovedByTheThreshold)
{
    // 12 pixels a metre and 0.5 pixels: 1/24 m, at 1 m/s 1/24 s. A block of a quarter of the size has four
    // times as long.
    const render::BlockContent content = contentOf(1, 100, 1.0f);
    const auto jobsFor = [&](float pixels) {
        size_t jobs = 0;
        for (int frame = 0; frame < 96; ++frame) {
            tiles_.begin(settings_);
            find(content, {0, 0, -1}, pixels, double(frame) / 96.0);
            jobs += tiles_.jobs().size();
        }
        return jobs;
    };
    const size_t large = jobsFor(24.0f), small = jobsFor(6.0f);
    EXPECT_GE(large, 19u);
    EXPECT_LE(large, 25u);
    EXPECT_GE(small, 9u); // after 0.1 s at the latest
    EXPECT_LE(small, 11u);
}

TEST_F(TileCache, contentWithoutBallsOrWithTooManyHasNoTile)
{
    tiles_.begin(settings_);
    EXPECT_FALSE(find(contentOf(1, 0), {0, 0, -1}));
    EXPECT_FALSE(find(contentOf(2, render::kMaxTileBalls + 1), {0, 0, -1}));
    EXPECT_TRUE(find(contentOf(3, render::kMaxTileBalls), {0, 0, -1}));
    // Each ball of colored content takes two turns of the loops of the shader.
    render::BlockContent colored = contentOf(4, render::kMaxTileBalls / 2 + 1);
    colored.isColored = true;
    EXPECT_FALSE(find(colored, {0, 0, -1}));
    colored = contentOf(5, render::kMaxTileBalls / 2);
    colored.isColored = true;
    EXPECT_TRUE(find(colored, {0, 0, -1}));
}

TEST_F(TileCache, theEyeOfATileIsNeverInTheBlock)
{
    settings_.parallax = 16.0f; // of any distance
    tiles_.begin(settings_);
    const render::BlockContent content = contentOf(1);
    for (const float pixels : {1.0f, 8.0f, 64.0f, 400.0f})
        for (float nearness = 0.0f; nearness <= 1.0f; nearness += 0.05f) {
            render::TileRequest request{0, &content, {0, 0, -1}, pixels, 0.0};
            request.nearness = nearness;
            const auto tile = tiles_.find(request);
            ASSERT_TRUE(tile);
            EXPECT_LE(tile->nearness, render::kMaxNearness) << pixels << ' ' << nearness;
            EXPECT_NEAR(tile->nearness, std::min(nearness, render::kMaxNearness), 0.13f);
        }
}

TEST_F(TileCache, whatTheContentCanReplaceIsLeftOutWhereManyTilesAreDue)
{
    tiles_.begin(settings_);
    for (uint64_t i = 0; i < 400; ++i)
        ASSERT_TRUE(find(contentOf(1, 50'000), randomDirection(i), 64.0f));
    const render::BlockContent other = contentOf(2);
    render::TileRequest request{0, &other, {0, 0, -1}, 24.0f, 0.0};
    request.isOptional = true;
    const uint32_t deferred = tiles_.deferred();
    EXPECT_FALSE(tiles_.find(request));
    EXPECT_EQ(tiles_.deferred(), deferred + 1);
    const size_t jobs = tiles_.jobs().size();
    request.isOptional = false;
    EXPECT_TRUE(tiles_.find(request));
    EXPECT_EQ(tiles_.jobs().size(), jobs + 1);
    request.isOptional = true;
    EXPECT_TRUE(tiles_.find(request)); // it is there
    tiles_.begin(settings_);
    const render::BlockContent third = contentOf(3);
    request.content = &third;
    EXPECT_TRUE(tiles_.find(request)); // there is time
}
