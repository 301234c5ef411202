/// @file budget_host.h
/// A host for tests, which sets the work budget of its scene.
#pragma once

#include "tests/api/api_fixture.h"

namespace fx::test {

inline FxSceneStatistics statisticsOf(FxScene* scene)
{
    FxSceneStatistics statistics = {};
    statistics.structSize = sizeof statistics;
    EXPECT_EQ(fxScene_GetStatistics(scene, &statistics), FX_OK);
    return statistics;
}

inline uint64_t hashOf(FxScene* scene)
{
    uint64_t hash = 0;
    EXPECT_EQ(fxScene_GetStateHash(scene, &hash), FX_OK);
    return hash;
}

inline uint64_t simulationHashOf(FxScene* scene)
{
    uint64_t hash = 0;
    EXPECT_EQ(fxScene_GetSimulationHash(scene, &hash), FX_OK);
    return hash;
}

/// A host with a context and a scene of its own.
class Host
{
public:
    explicit Host(uint64_t budget, uint32_t workers = 1, int64_t longestDebt = 30 * FX_TICKS_PER_SECOND,
                  HostAllocator* memory = nullptr)
    {
        FxContextDef contextDef = fxDefaultContextDef();
        contextDef.workers = workers;
        if (memory)
            contextDef.allocator = memory->hooks();
        EXPECT_EQ(fxCreateContext(&contextDef, &context_), FX_OK);
        FxSceneDef def = fxDefaultSceneDef();
        def.workBudget = budget;
        def.maxCatchUpTicks = longestDebt;
        EXPECT_EQ(fxCreateScene(context_, &def, &scene_), FX_OK);
    }
    ~Host() { fxDestroyContext(context_); }
    Host(const Host&) = delete;
    Host& operator=(const Host&) = delete;

    FxInstanceId add(const std::string& preset, uint64_t seed = 7)
    {
        FxInstanceDef def = fxDefaultInstanceDef();
        def.preset = loadText(context_, preset);
        def.seed = seed;
        FxInstanceId id = {};
        EXPECT_EQ(fxScene_CreateInstance(scene_, &def, &id), FX_OK);
        return id;
    }
    FxSceneStatistics update(double seconds)
    {
        EXPECT_EQ(fxScene_Update(scene_, seconds), FX_OK);
        return statisticsOf(scene_);
    }
    /// Updates by 0 s until the scene has no time debt.
    void payDebt()
    {
        for (int i = 0; i < 100'000 && update(0.0).timeDebtTicks > 0; ++i) {
        }
        EXPECT_EQ(statisticsOf(scene_).timeDebtTicks, 0);
    }
    FxInstanceState stateOf(FxInstanceId id)
    {
        FxInstanceState state = FX_INSTANCE_FINISHED;
        EXPECT_EQ(fxScene_GetInstanceState(scene_, id, &state, nullptr), FX_OK);
        return state;
    }
    FxScene* scene() { return scene_; }

private:
    FxContext* context_ = nullptr;
    FxScene* scene_ = nullptr;
};

} // namespace fx::test
