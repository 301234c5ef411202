#include "tests/api/counting_new.h"
#include "tests/simulation/fragments/fragment_burst.h"

#include <gtest/gtest.h>

using namespace fx;
using namespace fx::test;

TEST(FragmentsAllocations, stepAndPublishMakeNoneAfterTheFirst)
{
    Stage stage;
    stage.add({}, grounded(burst(60)));
    stage.play(1); // scratch memory takes its size
    stage.look();
    const uint64_t before = newCalls();
    const uint64_t hostBefore = stage.memory().allocationCount();
    for (int i = 0; i < 90; ++i) {
        stage.step();
        stage.look();
    }
    EXPECT_GT(stage.counters().born, 500u);
    EXPECT_EQ(newCalls() - before, 0u);
    EXPECT_EQ(stage.memory().allocationCount() - hostBefore, 0u);
}

TEST(FragmentsAllocations, theCounterCounts)
{
    const uint64_t before = newCalls();
    ::operator delete(::operator new(4)); // a direct call, which no compiler may leave out
    EXPECT_EQ(newCalls() - before, 1u);
}
