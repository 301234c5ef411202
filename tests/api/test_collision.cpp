#include "tests/api/api_fixture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <string>

using fx::test::kFrame;
using fx::test::loadText;

namespace {

/// A wall from x = 2 m to x = 2.5 m as an indexed box.
struct Wall
{
    Wall()
    {
        for (int i = 0; i < 8; ++i)
            for (const float x : {i & 1 ? 2.5f : 2.0f, i & 2 ? 15.0f : -15.0f, i & 4 ? 15.0f : -15.0f})
                positions[size++] = x;
        mesh.positions = positions.data();
        mesh.indices = indices.data();
        mesh.vertexCount = 8;
        mesh.indexCount = uint32_t(indices.size());
        mesh.cellSize = 0.25f;
    }
    size_t size = 0;
    std::array<float, 24> positions{};
    std::array<uint32_t, 36> indices{0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5, 0, 1, 5, 0, 5, 4,
                                     2, 6, 7, 2, 7, 3, 0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6};
    FxCollisionMesh mesh = fxDefaultCollisionMesh();
};

constexpr const char* kFireball = R"({"version": 1, "ground": false, "gas": [{"particles": 150,
    "energy": 10e6, "dissipation": 0}]})";
constexpr const char* kDebris = R"({"version": 1, "ground": false, "fragments": [{"count": 200, "speed": 25,
    "lifetime": 100, "trail": {"spacing": 0}}]})";

class CollisionApi : public fx::test::ApiTest
{
protected:
    FxInstanceId add(const char* preset, double x = 0.0)
    {
        FxInstanceDef def = fxDefaultInstanceDef();
        FxPresetId& loaded = presets_[preset];
        if (loaded.bits == 0)
            loaded = loadText(context_, preset);
        def.preset = loaded;
        def.position[0] = x;
        FxInstanceId id{};
        EXPECT_EQ(fxScene_CreateInstance(scene_, &def, &id), FX_OK) << fxGetLastErrorMessage();
        return id;
    }

    /// [m] largest local x of all that is shown.
    float farthest() const
    {
        FxSnapshotId snapshot{};
        EXPECT_EQ(fxScene_AcquireSnapshot(scene_, &snapshot), FX_OK);
        FxSnapshotInfo info{};
        info.structSize = sizeof info;
        EXPECT_EQ(fxScene_GetSnapshotInfo(scene_, snapshot, &info), FX_OK);
        float most = -std::numeric_limits<float>::infinity();
        for (uint32_t group = 0; group < info.groupsNewer; ++group) {
            FxSnapshotColumn column{};
            column.structSize = sizeof column;
            EXPECT_EQ(fxScene_GetSnapshotColumn(scene_, snapshot, FX_SNAPSHOT_NEWER, group, 0, &column),
                      FX_OK);
            for (uint64_t i = 0; i < column.count; ++i)
                most = std::max(most, column.values[i]);
        }
        EXPECT_EQ(fxScene_ReleaseSnapshot(scene_, snapshot), FX_OK);
        return most;
    }

    void expectRefused(const FxCollisionMesh& mesh, FxResult result, const std::string& part) const
    {
        const uint64_t before = simulationHash();
        EXPECT_EQ(fxScene_SetCollisionMesh(scene_, &mesh), result);
        EXPECT_NE(std::string(fxGetLastErrorMessage()).find(part), std::string::npos)
            << fxGetLastErrorMessage();
        EXPECT_EQ(simulationHash(), before);
    }

private:
    std::map<std::string, FxPresetId> presets_;
};

} // namespace

TEST_F(CollisionApi, aBallOfGasBesideAWallStaysOnItsSideAndPassesWithoutTheWall)
{
    FX_NEEDS_GAS();
    const Wall wall;
    ASSERT_EQ(fxScene_SetCollisionMesh(scene_, &wall.mesh), FX_OK) << fxGetLastErrorMessage();
    const FxInstanceId id = add(kFireball);
    for (int frame = 0; frame < 60; ++frame) {
        play(1);
        ASSERT_LT(farthest(), 2.0f) << "frame " << frame;
    }
    ASSERT_EQ(fxScene_DestroyInstance(scene_, id), FX_OK);
    ASSERT_EQ(fxScene_SetCollisionMesh(scene_, nullptr), FX_OK);
    add(kFireball);
    play(60);
    EXPECT_GT(farthest(), 2.2f);
}

TEST_F(CollisionApi, fragmentsBounceOffAWall)
{
    const Wall wall;
    ASSERT_EQ(fxScene_SetCollisionMesh(scene_, &wall.mesh), FX_OK);
    add(kDebris);
    for (int frame = 0; frame < 30; ++frame) {
        play(1);
        ASSERT_LT(farthest(), 2.0f) << "frame " << frame;
    }
}

TEST_F(CollisionApi, theMeshStandsInTheWorldWhereverTheInstanceIs)
{
    Wall wall;
    wall.mesh.origin[0] = 1e6;
    ASSERT_EQ(fxScene_SetCollisionMesh(scene_, &wall.mesh), FX_OK);
    add(kDebris, 1e6 + 1.0);
    play(30);
    EXPECT_LT(farthest(), 1.0f);
}

TEST_F(CollisionApi, aMeshThatComesWhileEffectsRunHoldsFromThenOn)
{
    FX_NEEDS_GAS();
    add(kFireball);
    add(kFireball, -1.0);
    play(5);
    EXPECT_EQ(statistics().simulations, 1u);
    const Wall wall;
    ASSERT_EQ(fxScene_SetCollisionMesh(scene_, &wall.mesh), FX_OK);
    EXPECT_EQ(statistics().simulations, 2u); // they will meet the wall at different times
    play(40);
    ASSERT_EQ(fxScene_SetCollisionMesh(scene_, nullptr), FX_OK);
    play(10);
}

TEST_F(CollisionApi, withoutAMeshEverythingIsAsIfThereHadNeverBeenOne)
{
    FX_NEEDS_GAS();
    add(kFireball);
    play(20);
    const uint64_t untouched = simulationHash();
    FxScene* other = nullptr;
    const FxSceneDef def = fxDefaultSceneDef();
    ASSERT_EQ(fxCreateScene(context_, &def, &other), FX_OK);
    const Wall wall;
    ASSERT_EQ(fxScene_SetCollisionMesh(other, &wall.mesh), FX_OK);
    ASSERT_EQ(fxScene_SetCollisionMesh(other, nullptr), FX_OK);
    FxInstanceDef instance = fxDefaultInstanceDef();
    instance.preset = loadText(context_, kFireball);
    FxInstanceId id{};
    ASSERT_EQ(fxScene_CreateInstance(other, &instance, &id), FX_OK);
    for (int frame = 0; frame < 20; ++frame)
        ASSERT_EQ(fxScene_Update(other, kFrame), FX_OK);
    uint64_t hash = 0;
    ASSERT_EQ(fxScene_GetSimulationHash(other, &hash), FX_OK);
    EXPECT_EQ(hash, untouched);
    EXPECT_EQ(fxDestroyScene(other), FX_OK);
}

TEST_F(CollisionApi, aStateContinuesWithItsMeshAndIsRefusedWithAnother)
{
    FX_NEEDS_GAS();
    Wall wall;
    ASSERT_EQ(fxScene_SetCollisionMesh(scene_, &wall.mesh), FX_OK);
    add(kFireball);
    add(kDebris, -1.0);
    play(10);
    const std::vector<std::byte> state = savedState();
    play(30);
    const uint64_t first = simulationHash();
    ASSERT_EQ(restore(state), FX_OK) << fxGetLastErrorMessage();
    play(30);
    EXPECT_EQ(simulationHash(), first);

    ASSERT_EQ(fxScene_SetCollisionMesh(scene_, nullptr), FX_OK);
    EXPECT_EQ(restore(state), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_NE(std::string(fxGetLastErrorMessage()).find("collision mesh"), std::string::npos);
    const std::vector<std::byte> without = savedState();
    wall.positions[0] -= 0.5f;
    ASSERT_EQ(fxScene_SetCollisionMesh(scene_, &wall.mesh), FX_OK);
    EXPECT_EQ(restore(state), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(restore(without), FX_ERROR_INVALID_ARGUMENT);
    wall.positions[0] += 0.5f;
    ASSERT_EQ(fxScene_SetCollisionMesh(scene_, &wall.mesh), FX_OK);
    EXPECT_EQ(restore(state), FX_OK) << fxGetLastErrorMessage();
}

TEST_F(CollisionApi, wrongMeshesAreRefusedByName)
{
    const Wall good;
    EXPECT_EQ(fxScene_SetCollisionMesh(nullptr, &good.mesh), FX_ERROR_INVALID_ARGUMENT);
    const auto refuse = [&](auto&& spoil, FxResult result, const char* part) {
        Wall wall;
        spoil(wall);
        expectRefused(wall.mesh, result, part);
    };
    const FxResult invalid = FX_ERROR_INVALID_ARGUMENT;
    refuse([](Wall& w) { w.mesh.structSize = 3; }, FX_ERROR_VERSION, "mesh.structSize");
    refuse([](Wall& w) { w.mesh.positions = nullptr; }, invalid, "mesh.positions");
    refuse([](Wall& w) { w.mesh.vertexCount = 0; }, invalid, "mesh.vertexCount");
    refuse([](Wall& w) { w.mesh.vertexCount = ~0u; }, invalid, "mesh.vertexCount");
    refuse([](Wall& w) { w.mesh.indexCount = 0; }, invalid, "mesh.indexCount");
    refuse([](Wall& w) { w.mesh.indexCount = 35; }, invalid, "within a triangle");
    refuse([](Wall& w) { w.mesh.indices = nullptr; }, invalid, "mesh.indexCount");
    refuse([](Wall& w) { w.mesh.vertexCount = 7; }, invalid, "index ");
    for (const float wrong : {-1.0f, 1e-4f, 2e3f, NAN, INFINITY})
        refuse([=](Wall& w) { w.mesh.cellSize = wrong; }, invalid, "mesh.cellSize");
    for (const double wrong : {2e9, double(NAN)})
        refuse([=](Wall& w) { w.mesh.origin[1] = wrong; }, invalid, "mesh.origin");
    for (const float wrong : {NAN, INFINITY, -2e5f})
        refuse([=](Wall& w) { w.positions[13] = wrong; }, invalid, "position 4");
    refuse([](Wall& w) { w.positions.fill(1.0f); }, invalid, "no triangle with an area");
    refuse([](Wall& w) { w.mesh.cellSize = 0.01f; }, FX_ERROR_CAPACITY, "cells");
    EXPECT_EQ(fxScene_SetCollisionMesh(scene_, &good.mesh), FX_OK);
}

TEST_F(CollisionApi, anAutomaticCellAndTriangleSoupAreTaken)
{
    const std::array<float, 9> sheet{2, -15, -15, 2, 15, -15, 2, 0, 15};
    FxCollisionMesh mesh = fxDefaultCollisionMesh();
    mesh.positions = sheet.data();
    mesh.vertexCount = 3;
    ASSERT_EQ(fxScene_SetCollisionMesh(scene_, &mesh), FX_OK) << fxGetLastErrorMessage();
    add(kDebris);
    play(10);
    EXPECT_LT(farthest(), 2.0f);
}

TEST_F(CollisionApi, theMeshMayGoAfterTheCallAndItsMemoryComesBack)
{
    FX_NEEDS_GAS();
    const uint64_t before = bytesInUse();
    {
        const Wall wall;
        ASSERT_EQ(fxScene_SetCollisionMesh(scene_, &wall.mesh), FX_OK);
    }
    EXPECT_GT(bytesInUse(), before + 100'000);
    EXPECT_LT(bytesInUse(), before + 8'000'000); // the grid, and nothing of what it was made from
    ASSERT_EQ(fxScene_SetCollisionMesh(scene_, nullptr), FX_OK);
    EXPECT_EQ(bytesInUse(), before);
}

TEST(CollisionDeterminism, anyNumberOfWorkersGivesTheSameBits)
{
    FX_NEEDS_GAS();
    std::array<uint64_t, 4> hashes{};
    for (size_t i = 0; i < hashes.size(); ++i) {
        FxContextDef contextDef = fxDefaultContextDef();
        contextDef.workers = std::array{1u, 2u, 3u, 7u}[i];
        FxContext* context = nullptr;
        ASSERT_EQ(fxCreateContext(&contextDef, &context), FX_OK);
        const FxSceneDef sceneDef = fxDefaultSceneDef();
        FxScene* scene = nullptr;
        ASSERT_EQ(fxCreateScene(context, &sceneDef, &scene), FX_OK);
        const Wall wall;
        ASSERT_EQ(fxScene_SetCollisionMesh(scene, &wall.mesh), FX_OK);
        for (const char* preset : {kFireball, kDebris}) {
            FxInstanceDef def = fxDefaultInstanceDef();
            def.preset = loadText(context, preset);
            FxInstanceId id{};
            ASSERT_EQ(fxScene_CreateInstance(scene, &def, &id), FX_OK);
        }
        for (int frame = 0; frame < 40; ++frame)
            ASSERT_EQ(fxScene_Update(scene, kFrame), FX_OK);
        ASSERT_EQ(fxScene_GetSimulationHash(scene, &hashes[i]), FX_OK);
        EXPECT_EQ(hashes[i], hashes[0]);
        ASSERT_EQ(fxDestroyContext(context), FX_OK);
    }
}
