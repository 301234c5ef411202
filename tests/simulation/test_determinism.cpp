#include "tests/foundation/real_threads.h"
#include "tests/simulation/busy_effect.h"

#include <gtest/gtest.h>

using namespace fx;
using namespace fx::test;

namespace {

/// Hash of every tenth state of a second.
std::vector<uint64_t> history(std::unique_ptr<base::TaskRunner> tasks, uint64_t seed = 1,
                              bool detailed = false)
{
    Stage stage(std::move(tasks));
    sim::InstanceStart start;
    start.seed = seed;
    stage.add(start, busyEffect(1000, detailed));
    std::vector<uint64_t> hashes;
    for (int i = 0; i < 6; ++i) {
        stage.play(10);
        hashes.push_back(stage.look().hash());
    }
    return hashes;
}

/// A host that cuts loops into uneven ranges and runs them last to first.
void unevenly(void*, uint32_t count, uint32_t minBatch, base::LoopBody body, void* argument)
{
    uint32_t end = count;
    for (uint32_t k = 1; end > 0; ++k) {
        const uint32_t size = std::min(end, minBatch * (1 + k % 3));
        body(argument, end - size, end);
        end -= size;
    }
}

} // namespace

TEST(Determinism, everyThreadCountGivesTheSameBits)
{
    const RealThreads threadsOfAnyMachine(8);
    const std::vector<uint64_t> want = history(base::makeSerialRunner());
    for (const uint32_t threads : {1u, 2u, 3u, 8u})
        EXPECT_EQ(history(base::makeTbbRunner(threads)), want) << threads;
}

TEST(Determinism, soDoCoordinatesForDetail)
{
    const RealThreads threadsOfAnyMachine(8);
    const std::vector<uint64_t> want = history(base::makeSerialRunner(), 1, true);
    EXPECT_NE(want, history(base::makeSerialRunner()));
    for (const uint32_t threads : {2u, 8u})
        EXPECT_EQ(history(base::makeTbbRunner(threads), 1, true), want) << threads;
}

TEST(Determinism, anyWayOfCuttingLoopsGivesTheSameBits)
{
    EXPECT_EQ(history(base::makeHostRunner({nullptr, unevenly})), history(base::makeSerialRunner()));
}

TEST(Determinism, theSeedMatters)
{
    EXPECT_NE(history(base::makeSerialRunner(), 1), history(base::makeSerialRunner(), 2));
}

TEST(Determinism, otherInstancesDoNotMatter)
{
    const auto lastOf = [](bool crowded) {
        Stage stage;
        sim::InstanceStart start;
        start.seed = 5;
        start.instance = 1;
        stage.add(start, busyEffect(400));
        if (crowded) {
            start.seed = 6;
            start.instance = 2;
            stage.add(start, busyEffect(300));
        }
        stage.play(30);
        const auto x = stage.look().group(1).column(base::blob_column::PositionX);
        return std::vector<float>(x.begin(), x.end());
    };
    EXPECT_EQ(lastOf(false), lastOf(true));
}
