// Everything that the headers allow at once, on threads of the host: results are those of one thread alone.
// Built with -fsanitize=thread, these tests find what is not ordered.
#include "tests/api/api_fixture.h"
#include "tests/api/background_calls.h"
#include "tests/api/host_threads.h"
#include "tests/api/scene_script.h"

#include <array>
#include <latch>
#include <memory>
#include <thread>
#include <vector>

using fx::test::BackgroundCalls;
using fx::test::HostAllocator;
using fx::test::HostThreads;
using fx::test::SceneScript;

namespace {

constexpr size_t kContexts = 2;
constexpr uint32_t kScenes = 3; ///< two of them in one context
constexpr int kFrames = 40;

using Hashes = std::array<uint64_t, kScenes>;

FxContext* makeContext(HostAllocator& memory, const FxParallelFor& parallelFor)
{
    FxContextDef def = fxDefaultContextDef();
    def.allocator = memory.hooks();
    def.parallelFor = parallelFor;
    def.workers = 1;
    FxContext* context = nullptr;
    EXPECT_EQ(fxCreateContext(&def, &context), FX_OK) << fxGetLastErrorMessage();
    return context;
}

/// Each scene by itself, on this thread.
Hashes playAlone()
{
    Hashes hashes{};
    for (uint32_t i = 0; i < kScenes; ++i) {
        HostAllocator memory;
        FxContext* const context = makeContext(memory, {});
        SceneScript script(context, i);
        script.play(kFrames);
        hashes[i] = script.simulationHash();
        EXPECT_EQ(fxDestroyContext(context), FX_OK) << fxGetLastErrorMessage();
        EXPECT_EQ(memory.blocks(), 0);
    }
    return hashes;
}

/// All scenes at once, each on a thread of its own, while others read and load.
Hashes playTogether(uint32_t helpers)
{
    HostThreads host(helpers);
    HostAllocator memory;
    std::array<FxContext*, kContexts> contexts{};
    for (FxContext*& context : contexts)
        context = makeContext(memory, host.hook());
    Hashes hashes{};
    std::array<FxScene*, kScenes> scenes{};
    std::latch created(kScenes), others(1);
    std::vector<std::thread> sceneThreads;
    for (uint32_t i = 0; i < kScenes; ++i)
        sceneThreads.emplace_back([&, i] {
            SceneScript script(contexts[i % kContexts], i);
            scenes[i] = script.scene();
            created.count_down();
            others.wait();
            script.play(kFrames);
            hashes[i] = script.simulationHash();
        });
    created.wait();
    BackgroundCalls calls;
    for (FxScene* const scene : scenes)
        calls.readSnapshots(scene);
    calls.readSnapshots(scenes[0]); // two read the same groups
    for (FxContext* const context : contexts) {
        calls.loadPresets(context);
        calls.readMemoryStatistics(context);
    }
    others.count_down();
    for (std::thread& thread : sceneThreads)
        thread.join();
    calls.stop();
    EXPECT_GT(calls.snapshots(), kScenes);
    EXPECT_GT(host.loops(), 100u);
    for (FxContext* const context : contexts)
        EXPECT_EQ(fxDestroyContext(context), FX_OK) << fxGetLastErrorMessage();
    EXPECT_EQ(memory.blocks(), 0);
    EXPECT_EQ(memory.bytes(), 0);
    return hashes;
}

} // namespace

TEST(HostThreads, coverEveryIndexOnceForSeveralCallersAtOnce)
{
    HostThreads host(3);
    const FxParallelFor hook = host.hook();
    const auto count = [&hook](std::vector<int>& visits, uint32_t batch) {
        hook.run(
            hook.user, uint32_t(visits.size()), batch,
            [](void* argument, uint32_t begin, uint32_t end) {
                for (uint32_t i = begin; i < end; ++i)
                    ++(*static_cast<std::vector<int>*>(argument))[i];
            },
            &visits);
    };
    std::vector<std::thread> callers;
    for (uint32_t batch = 1; batch <= 4; ++batch)
        callers.emplace_back([&count, batch] {
            for (const size_t size : {size_t(1), size_t(7), size_t(5000)}) {
                std::vector<int> visits(size, 0);
                count(visits, 100 * batch);
                EXPECT_EQ(visits, std::vector<int>(size, 1));
            }
        });
    for (std::thread& caller : callers)
        caller.join();
    EXPECT_EQ(host.loops(), 12u);
}

/// How many threads there are beside that of the caller: one to four workers.
class ThreadContract : public ::testing::TestWithParam<uint32_t>
{};

INSTANTIATE_TEST_SUITE_P(Helpers, ThreadContract, ::testing::Values(0u, 1u, 2u, 3u));

TEST_P(ThreadContract, scenesComeToTheSameWhateverOtherThreadsDo)
{
    EXPECT_EQ(playTogether(GetParam()), playAlone());
}
