#include "simulation/fragments/trail_smoke.h"

#include "simulation/emitters/emitter_def.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace fx::sim;

TEST(TrailSmoke, blobsAreCountedFromTheWayThatIsDue)
{
    EXPECT_EQ(blobsAlong(0.9f, 1.0f, 0.5f), 0u);
    EXPECT_EQ(blobsAlong(1.0f, 1.0f, 0.5f), 1u);
    EXPECT_EQ(blobsAlong(1.49f, 1.0f, 0.5f), 1u);
    EXPECT_EQ(blobsAlong(2.01f, 1.0f, 0.5f), 3u);
    EXPECT_EQ(blobsAlong(0.0f, 0.0f, 0.5f), 1u);
    EXPECT_EQ(blobsAlong(1.0f, 0.0f, 0.0f), 0u);
    EXPECT_LE(blobsAlong(1e30f, 0.0f, 1e-3f), 1000001u);
}

TEST(TrailSmoke, spreadsAsDiffusionDoesAndFadesToNothing)
{
    TrailDef def;
    def.spreading = 0.09f;
    def.temperature = 1000.0f;
    def.mixing = 2.0f;
    EXPECT_NEAR(smokeAppearance(def, 0.4f, 1.0f, 2.0f).radius, 0.5f, 1e-6f);
    EXPECT_NEAR(smokeAppearance(def, 0.4f, 0.5f, 2.0f).temperature,
                293.15 + (1000.0 - 293.15) * std::exp(-1.0), 1e-3);
    EXPECT_EQ(smokeAppearance(def, 0.4f, 0.0f, 2.0f).share, 1.0f);
    EXPECT_EQ(smokeAppearance(def, 0.4f, 2.0f, 2.0f).share, 0.0f);
    float last = 1.0f;
    for (float age = 0.0f; age < 2.0f; age += 0.1f) {
        EXPECT_LE(smokeAppearance(def, 0.4f, age, 2.0f).share, last);
        last = smokeAppearance(def, 0.4f, age, 2.0f).share;
    }
}

TEST(TrailSmoke, idsTellFragmentAndBlobApart)
{
    EXPECT_NE(trailId(1, 0), trailId(0, 1));
    EXPECT_NE(trailId(8191, 5), trailId(8190, 5));
    EXPECT_LT(trailId(8191, 0xFFFFFF), uint64_t(1) << 39); // leaves room for the mark of smoke in an id
}
