#include "tests/api/api_fixture.h"

#include <array>
#include <thread>
#include <vector>

using fx::test::burstPreset;
using fx::test::fountainPreset;
using fx::test::loadText;

namespace {

constexpr int64_t kRunTicks = FX_TICKS_PER_SECOND; // 1 s: a whole number of frames at every rate below

/// A host's parallel loop: three threads that take batches in turn, so that the cut differs from the
/// library's.
void threeThreads(void*, uint32_t count, uint32_t minBatch, FxLoopBody body, void* argument)
{
    std::array<std::thread, 3> threads;
    for (uint32_t t = 0; t < threads.size(); ++t)
        threads[t] = std::thread([=] {
            for (uint32_t begin = t * minBatch; begin < count; begin += 3 * minBatch)
                body(argument, begin, std::min(begin + minBatch, count));
        });
    for (std::thread& thread : threads)
        thread.join();
}

/// State after one second of a busy scene.
uint64_t run(const FxContextDef& contextDef, const std::vector<double>& frames)
{
    FxContext* context = nullptr;
    EXPECT_EQ(fxCreateContext(&contextDef, &context), FX_OK);
    FxScene* scene = nullptr;
    const FxSceneDef sceneDef = fxDefaultSceneDef();
    EXPECT_EQ(fxCreateScene(context, &sceneDef, &scene), FX_OK);
    FxPresetId explosion{};
    EXPECT_EQ(fxLoadPresetLibrary(context, fx::test::kLargeEffect, &explosion), FX_OK);
    const FxPresetId presets[3] = {loadText(context, fountainPreset()),
                                   loadText(context, burstPreset(5000, 3.0)), explosion};
    for (int i = 0; i < 6; ++i) {
        FxInstanceDef def = fxDefaultInstanceDef();
        def.preset = presets[i % 3];
        def.seed = uint64_t(i);
        def.startTick = FX_TICKS_PER_SECOND / 37 * i; // not on steps
        def.position[0] = 10.0 * i;
        FxInstanceId id;
        EXPECT_EQ(fxScene_CreateInstance(scene, &def, &id), FX_OK);
    }
    for (const double dt : frames)
        EXPECT_EQ(fxScene_Update(scene, dt), FX_OK);
    FxSceneStatistics statistics{};
    statistics.structSize = sizeof statistics;
    EXPECT_EQ(fxScene_GetStatistics(scene, &statistics), FX_OK);
    EXPECT_EQ(statistics.simulatedTick, kRunTicks);
    EXPECT_GT(statistics.particles, 5000u);
    uint64_t hash = 0;
    EXPECT_EQ(fxScene_GetStateHash(scene, &hash), FX_OK);
    EXPECT_EQ(fxDestroyContext(context), FX_OK);
    return hash;
}

std::vector<double> atRate(int hertz)
{
    return std::vector<double>(size_t(hertz), 1.0 / hertz);
}

FxContextDef withWorkers(uint32_t workers)
{
    FxContextDef def = fxDefaultContextDef();
    def.workers = workers;
    return def;
}

} // namespace

TEST(Determinism, anyNumberOfThreadsAndTheHostsOwnGiveTheSameBits)
{
    const uint64_t serial = run(withWorkers(1), atRate(60));
    EXPECT_EQ(run(withWorkers(2), atRate(60)), serial);
    EXPECT_EQ(run(withWorkers(3), atRate(60)), serial);
    FxContextDef host = fxDefaultContextDef();
    host.parallelFor.run = &threeThreads;
    EXPECT_EQ(run(host, atRate(60)), serial);
}

TEST(Determinism, anyFrameRateGivesTheSameBits)
{
    const uint64_t sixty = run(withWorkers(1), atRate(60));
    for (const int hertz : {30, 144, 240})
        EXPECT_EQ(run(withWorkers(1), atRate(hertz)), sixty) << hertz << " Hz";
    std::vector<double> uneven;
    for (int i = 0; i < 30; ++i)
        uneven.insert(uneven.end(), {0.25 / 30, 0.0, 0.75 / 30});
    EXPECT_EQ(run(withWorkers(1), uneven), sixty);
}
