#include "tests/api/api_fixture.h"
#include "tests/api/counting_new.h"

using fx::test::kFrame;
using fx::test::newCalls;
using AllocationApi = fx::test::ApiTest;

TEST_F(AllocationApi, theCounterCounts)
{
    const uint64_t before = newCalls();
    ::operator delete(::operator new(1)); // unlike `new int`, never optimized away
    EXPECT_EQ(newCalls(), before + 1);
}

TEST_F(AllocationApi, aWarmSceneUpdatesWithoutAnyAllocation)
{
    FX_NEEDS_GAS();
    FxInstanceDef def = instanceDef();
    FxInstanceId id{};
    for (int i = 0; i < 3; ++i)
        ASSERT_EQ(fxScene_CreateInstance(scene_, &def, &id), FX_OK);
    def.preset = fx::test::loadText(
        context_, R"({"version": 1, "gas": [{"particles": 200, "dissipation": 0}], "emitters": [{
            "emission": {"rate": 200}, "lifetime": 1, "forces": {"curlStrength": 2, "bounce": 0.5}}]})");
    ASSERT_EQ(fxScene_CreateInstance(scene_, &def, &id), FX_OK);
    for (int frame = 0; frame < 90; ++frame)
        ASSERT_EQ(fxScene_Update(scene_, kFrame), FX_OK);

    const uint64_t before = newCalls();
    for (int frame = 0; frame < 120; ++frame) {
        ASSERT_EQ(fxScene_Update(scene_, frame % 3 == 0 ? 2 * kFrame : 0.5 * kFrame), FX_OK);
        ASSERT_EQ(statistics().updateAllocations, 0u) << "frame " << frame;
    }
    EXPECT_EQ(newCalls() - before, 0u);
    EXPECT_GT(statistics().particles, 400u);
}

TEST_F(AllocationApi, anExplosionAllocatesNothingFromItsFifthFrameToItsEnd)
{
    FxPresetId preset{};
    ASSERT_EQ(fxLoadPresetLibrary(context_, fx::test::kLargeEffect, &preset), FX_OK);
    FxInstanceDef def = instanceDef();
    def.preset = preset;
    FxInstanceId id{};
    ASSERT_EQ(fxScene_CreateInstance(scene_, &def, &id), FX_OK);
    for (int frame = 0; frame < 5; ++frame) // each snapshot of the ring is filled once
        ASSERT_EQ(fxScene_Update(scene_, kFrame), FX_OK);
    const uint64_t before = newCalls();
    for (int frame = 0; frame < 300; ++frame) {
        ASSERT_EQ(fxScene_Update(scene_, kFrame), FX_OK);
        ASSERT_EQ(statistics().updateAllocations, 0u) << "frame " << frame;
    }
    EXPECT_EQ(newCalls() - before, 0u);
}

TEST_F(AllocationApi, collisionsAllocateNothingOnceTheSceneIsWarm)
{
    const float corners[9] = {2, -15, -15, 2, 15, -15, 2, 0, 15};
    FxCollisionMesh mesh = fxDefaultCollisionMesh();
    mesh.positions = corners;
    mesh.vertexCount = 3;
    mesh.cellSize = 0.5f;
    ASSERT_EQ(fxScene_SetCollisionMesh(scene_, &mesh), FX_OK) << fxGetLastErrorMessage();
    FxPresetId preset{};
    ASSERT_EQ(fxLoadPresetLibrary(context_, fx::test::kLargeEffect, &preset), FX_OK);
    FxInstanceDef def = instanceDef();
    def.preset = preset;
    FxInstanceId id{};
    ASSERT_EQ(fxScene_CreateInstance(scene_, &def, &id), FX_OK);
    for (int frame = 0; frame < 5; ++frame)
        ASSERT_EQ(fxScene_Update(scene_, kFrame), FX_OK);
    const uint64_t before = newCalls();
    for (int frame = 0; frame < 60; ++frame) {
        ASSERT_EQ(fxScene_Update(scene_, kFrame), FX_OK);
        ASSERT_EQ(statistics().updateAllocations, 0u) << "frame " << frame;
    }
    EXPECT_EQ(newCalls() - before, 0u);
}
