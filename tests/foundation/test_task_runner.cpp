#include "foundation/tasks/task_runner.h"

#include <gtest/gtest.h>

#include <atomic>
#include <vector>

using namespace fx::base;

namespace {

/// A host that hands out ranges of exactly the smallest batch, last first.
void backwards(void* user, uint32_t count, uint32_t minBatch, LoopBody body, void* argument)
{
    ++*static_cast<int*>(user);
    for (uint32_t end = count; end > 0;) {
        const uint32_t begin = (end - 1) / minBatch * minBatch;
        body(argument, begin, end);
        end = begin;
    }
}

void expectEveryIndexOnce(TaskRunner& runner, uint32_t count, uint32_t batch)
{
    std::vector<std::atomic<int>> visits(count);
    runner.parallelFor(count, batch, [&](uint32_t begin, uint32_t end) {
        for (uint32_t i = begin; i < end; ++i)
            visits[i].fetch_add(1);
    });
    for (uint32_t i = 0; i < count; ++i)
        ASSERT_EQ(visits[i].load(), 1) << i << " of " << count;
}

} // namespace

TEST(TaskRunner, everyIndexIsVisitedOnceByEveryKind)
{
    int hostCalls = 0;
    std::vector<std::unique_ptr<TaskRunner>> runners;
    runners.push_back(makeSerialRunner());
    runners.push_back(makeTbbRunner());
    runners.push_back(makeTbbRunner(1));
    runners.push_back(makeTbbRunner(3));
    runners.push_back(makeHostRunner({&hostCalls, backwards}));
    for (const auto& runner : runners)
        for (const uint32_t count : {0u, 1u, 7u, 8u, 9u, 1000u, 4097u})
            for (const uint32_t batch : {0u, 1u, 8u, 5000u})
                expectEveryIndexOnce(*runner, count, batch);
    EXPECT_GT(hostCalls, 0);
}

TEST(TaskRunner, nothingToDoCallsNothing)
{
    int calls = 0;
    makeSerialRunner()->parallelFor(0, 1, [&](uint32_t, uint32_t) { ++calls; });
    makeTbbRunner(2)->parallelFor(0, 1, [&](uint32_t, uint32_t) { ++calls; });
    EXPECT_EQ(calls, 0);
}
