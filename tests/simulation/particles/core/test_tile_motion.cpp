#include "foundation/random/philox.h"
#include "simulation/motion/curl_noise.h"
#include "simulation/particles/builtin_ops.h"
#include "simulation/particles/tile_motion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

using namespace fx;
using namespace fx::sim;

namespace {

Tile oneRow(float speed, float seconds)
{
    Tile tile{};
    tile.count = 1;
    tile.padded = kTilePadding;
    tile.vx[0] = speed;
    tile.seconds[0] = seconds;
    return tile;
}

} // namespace

TEST(TileMotion, quadraticDragAloneSlowsDownExactly)
{
    for (const float seconds : {1e-3f, 0.1f, 10.0f}) {
        Tile tile = oneRow(30.0f, seconds);
        tile.quadratic[0] = 0.4f;
        integrate(tile);
        const double want = 30.0 / (1.0 + 0.4 * 30.0 * double(seconds));
        EXPECT_NEAR(tile.vx[0], want, 1e-6 * 30.0) << seconds;
        EXPECT_GE(tile.x[0], 0.0f);
        EXPECT_LE(tile.x[0], 30.0f * seconds);
    }
}

TEST(TileMotion, thePlaceUnderQuadraticDragIsOfSecondOrder)
{
    const auto errorWith = [](int steps) {
        Tile tile = oneRow(10.0f, 1.0f / float(steps));
        for (int i = 0; i < steps; ++i) {
            tile.quadratic[0] = 0.3f;
            integrate(tile);
        }
        return std::abs(double(tile.x[0]) - std::log(1.0 + 0.3 * 10.0) / 0.3);
    };
    EXPECT_NEAR(errorWith(4) / errorWith(8), 4.0, 0.5);
}

TEST(TileMotion, whatIsStuckOrEmptyStays)
{
    for (const uint32_t flag : {uint32_t(tile_flag::Stuck), uint32_t(tile_flag::Empty)}) {
        Tile tile = oneRow(5.0f, 1.0f);
        tile.flags[0] = flag;
        integrate(tile);
        EXPECT_EQ(tile.x[0], 0.0f);
    }
}

TEST(TileMotion, aRowBornWithinTheStepHasWhatIsLeftOfIt)
{
    Tile tile{};
    tile.count = 3;
    tile.padded = kTilePadding;
    base::Ticks born[kTilePadding] = {0, 7056000, 14112000};
    fillTimes({born, nullptr, 0.5f, 7056000, 21168000}, tile);
    EXPECT_FLOAT_EQ(tile.age[0], 0.01f);
    EXPECT_FLOAT_EQ(tile.seconds[0], 0.02f);
    EXPECT_EQ(tile.age[1], 0.0f);
    EXPECT_FLOAT_EQ(tile.seconds[1], 0.02f);
    EXPECT_EQ(tile.age[2], 0.0f);
    EXPECT_FLOAT_EQ(tile.seconds[2], 0.01f);
    EXPECT_FLOAT_EQ(tile.life[0], 0.005f);
}

TEST(TileMotion, turbulenceInLanesIsThatOfOnePlaceBitForBit)
{
    const CurlNoise noise(99, 1.7f, 0.6f, 12.25);
    Tile tile{};
    for (uint32_t i = 0; i < kTileRows; ++i) {
        tile.x[i] = -7.0f + 0.37f * float(i);
        tile.y[i] = 3.0f - 0.11f * float(i);
        tile.z[i] = 0.013f * float(i * i);
    }
    noise.addTo({tile.x, tile.y, tile.z}, {tile.ux, tile.uy, tile.uz}, kTileRows);
    for (uint32_t i = 0; i < kTileRows; ++i) {
        const glm::vec3 want = noise.velocity({tile.x[i], tile.y[i], tile.z[i]});
        ASSERT_EQ(tile.ux[i], want.x) << i;
        ASSERT_EQ(tile.uy[i], want.y) << i;
        ASSERT_EQ(tile.uz[i], want.z) << i;
    }
}

TEST(TileMotion, theGroundReflectsATileAsItReflectsEachRow)
{
    const sim::GroundContact ground{0.25f, 0.6f, 0.3f};
    auto tile = std::make_unique<sim::Tile>();
    tile->count = 250;
    tile->padded = 256;
    for (uint32_t i = 0; i < sim::kTileRows; ++i) {
        const auto u = base::randomUnit4(1, 0, i, base::RandomPurpose::Position);
        const auto w = base::randomUnit4(2, 0, i, base::RandomPurpose::Position);
        tile->fromX[i] = u[0];
        tile->fromY[i] = u[1]; // a quarter of them begin below
        tile->fromZ[i] = u[2];
        tile->fromVX[i] = 4.0f * u[3] - 2.0f;
        tile->fromVY[i] = 4.0f * w[0] - 3.0f;
        tile->fromVZ[i] = 4.0f * w[1] - 2.0f;
        tile->x[i] = tile->fromX[i] + 0.1f * tile->fromVX[i];
        tile->y[i] = i % 17 == 0 ? tile->fromY[i] : tile->fromY[i] + 0.2f * tile->fromVY[i];
        tile->z[i] = tile->fromZ[i] + 0.1f * tile->fromVZ[i];
        tile->vx[i] = tile->fromVX[i] * 0.9f;
        tile->vy[i] = tile->fromVY[i] - 1.0f;
        tile->vz[i] = tile->fromVZ[i] * 0.9f;
        tile->seconds[i] = 0.1f * w[2];
        tile->contact[i] = 0.5f;
        const uint32_t still = i % 5 == 3 ? sim::tile_flag::Stuck : sim::tile_flag::Empty;
        tile->flags[i] = i % 5 > 2 || i >= tile->count ? still : 0;
    }
    const sim::Tile before = *tile;
    sim::bounceTile(ground, *tile);
    uint32_t bounced = 0;
    for (uint32_t i = 0; i < tile->count; ++i) {
        const glm::vec3 position(before.x[i], before.y[i], before.z[i]);
        const glm::vec3 velocity(before.vx[i], before.vy[i], before.vz[i]);
        sim::MotionState want{position, velocity};
        const bool hits = before.flags[i] == 0 && position.y < ground.height;
        if (hits)
            want = sim::bounce({{before.fromX[i], before.fromY[i], before.fromZ[i]},
                                {before.fromVX[i], before.fromVY[i], before.fromVZ[i]}},
                               want, before.seconds[i], ground);
        bounced += hits ? 1 : 0;
        EXPECT_EQ(glm::vec3(tile->x[i], tile->y[i], tile->z[i]), want.position) << i;
        EXPECT_EQ(glm::vec3(tile->vx[i], tile->vy[i], tile->vz[i]), want.velocity) << i;
        const uint32_t marks = hits ? sim::tile_flag::Hit | sim::tile_flag::Collided : 0u;
        EXPECT_EQ(tile->flags[i], before.flags[i] | marks) << i;
        EXPECT_TRUE(hits ? tile->contact[i] >= 0.0f && tile->contact[i] <= 1.0f : tile->contact[i] == 0.5f);
    }
    EXPECT_GT(bounced, 30u);
}
