#include "tests/api/counting_new.h"
#include "tests/simulation/busy_effect.h"

#include <gtest/gtest.h>

using namespace fx;
using namespace fx::test;

TEST(Allocations, stepAndPublishMakeNoneAfterTheFirst)
{
    Stage stage;
    stage.add({}, busyEffect(400));
    stage.add({}, busyEffect(200));
    stage.play(1); // scratch memory takes its size
    stage.look();
    const uint64_t before = newCalls();
    const uint64_t hostBefore = stage.memory().allocationCount();
    for (int i = 0; i < 60; ++i) {
        stage.step();
        stage.look();
    }
    EXPECT_EQ(newCalls() - before, 0u);
    EXPECT_EQ(stage.memory().allocationCount() - hostBefore, 0u);
}

TEST(Allocations, theCounterCounts)
{
    const uint64_t before = newCalls();
    ::operator delete(::operator new(4)); // a direct call, which no compiler may leave out
    EXPECT_EQ(newCalls() - before, 1u);
}
