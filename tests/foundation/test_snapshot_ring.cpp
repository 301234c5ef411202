#include "foundation/memory/host_memory.h"
#include "foundation/snapshot/snapshot_ring.h"

#include <gtest/gtest.h>

#include <thread>

using namespace fx::base;

namespace {

class SnapshotRingTest : public ::testing::Test
{
protected:
    void publish(Ticks tick)
    {
        ring_.beginWrite(tick);
        ring_.publish();
    }

    HostMemory memory_;
    SnapshotSchema schema_;
    SnapshotRing ring_{&schema_, &memory_};
};

} // namespace

TEST_F(SnapshotRingTest, nothingIsThereBeforeTheFirstPublication)
{
    const SnapshotPair pair = ring_.acquire();
    EXPECT_EQ(pair.newer, nullptr);
    EXPECT_EQ(pair.older, nullptr);
    ring_.release(pair);
}

TEST_F(SnapshotRingTest, readersGetTheTwoNewest)
{
    publish(10);
    publish(20);
    publish(30);
    const SnapshotPair pair = ring_.acquire();
    EXPECT_EQ(pair.newer->tick(), 30);
    EXPECT_EQ(pair.older->tick(), 20);
    EXPECT_EQ(pair.newer->sequence(), 3u);
    ring_.release(pair);
}

TEST_F(SnapshotRingTest, whatIsBeingWrittenIsNotYetSeen)
{
    publish(10);
    ring_.beginWrite(20);
    const SnapshotPair pair = ring_.acquire();
    EXPECT_EQ(pair.newer->tick(), 10);
    ring_.release(pair);
}

TEST_F(SnapshotRingTest, aHeldPairNeverChangesHoweverMuchIsPublished)
{
    publish(10);
    publish(20);
    const SnapshotPair held = ring_.acquire();
    for (Ticks tick = 30; tick < 300; tick += 10)
        publish(tick);
    EXPECT_EQ(held.newer->tick(), 20);
    EXPECT_EQ(held.older->tick(), 10);
    ring_.release(held);
}

TEST_F(SnapshotRingTest, manyReadersMakeItGrowInsteadOfWait)
{
    std::vector<SnapshotPair> held;
    for (Ticks tick = 10; tick <= 120; tick += 10) {
        publish(tick);
        held.push_back(ring_.acquire());
    }
    for (size_t i = 0; i < held.size(); ++i)
        EXPECT_EQ(held[i].newer->tick(), Ticks(10 * (i + 1)));
    for (const SnapshotPair& pair : held)
        ring_.release(pair);
}

TEST_F(SnapshotRingTest, aReaderInAnotherThreadSeesTimeOnlyAdvance)
{
    publish(1);
    std::thread writer([this] {
        for (Ticks tick = 2; tick <= 2000; ++tick)
            publish(tick);
    });
    Ticks last = 0;
    while (last < 2000) {
        const SnapshotPair pair = ring_.acquire();
        ASSERT_GE(pair.newer->tick(), last);
        ASSERT_TRUE(!pair.older || pair.older->tick() + 1 == pair.newer->tick());
        last = pair.newer->tick();
        ring_.release(pair);
    }
    writer.join();
}

TEST_F(SnapshotRingTest, aStagedPredecessorIsSeenTogetherWithItsSuccessorAndNotBefore)
{
    publish(10);
    publish(20);
    ring_.beginWrite(20);
    ring_.stageOlder();
    SnapshotPair pair = ring_.acquire();
    EXPECT_EQ(pair.older->tick(), 10);
    const FrameSnapshot* const replaced = pair.newer;
    ring_.release(pair);
    publish(30);
    pair = ring_.acquire();
    EXPECT_EQ(pair.newer->tick(), 30);
    EXPECT_EQ(pair.older->tick(), 20);
    EXPECT_NE(pair.older, replaced);
    EXPECT_GT(pair.newer->sequence(), pair.older->sequence());
    EXPECT_GT(pair.older->sequence(), replaced->sequence());
    ring_.release(pair);
    publish(40);
    pair = ring_.acquire();
    EXPECT_EQ(pair.older->tick(), 30);
    ring_.release(pair);
}
