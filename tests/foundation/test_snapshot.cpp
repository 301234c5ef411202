#include "foundation/memory/host_memory.h"
#include "foundation/snapshot/blob_kind.h"
#include "foundation/snapshot/frame_snapshot.h"

#include <gtest/gtest.h>

using namespace fx::base;

namespace {

class SnapshotTest : public ::testing::Test
{
protected:
    /// A snapshot with one group of `count` blobs whose x is `x`.
    void write(FrameSnapshot& snapshot, Ticks tick, uint32_t count, float x)
    {
        snapshot.begin(tick, 1);
        SnapshotGroup& group = snapshot.addGroup(kind_, 8);
        group.editInfo().count = count;
        for (size_t c = 0; c < blob_column::Count; ++c)
            std::fill_n(group.editColumn(c).begin(), count, 0.0f);
        for (uint32_t i = 0; i < count; ++i) {
            group.editIds()[i] = i;
            group.editColumn(blob_column::PositionX)[i] = x;
        }
    }

    HostMemory memory_;
    SnapshotSchema schema_;
    KindId kind_ = schema_.add(kBlobKind);
};

} // namespace

TEST_F(SnapshotTest, theSchemaFindsKindsByNameAndAddsEachOnce)
{
    EXPECT_EQ(schema_.find("blob"), kind_);
    EXPECT_EQ(schema_.add(kBlobKind), kind_);
    EXPECT_EQ(schema_.size(), 1u);
    EXPECT_EQ(schema_.find("nothing"), kNoKind);
    EXPECT_EQ(schema_.kind(kind_).columns.size(), size_t(blob_column::Count));
    EXPECT_EQ(schema_.kind(kind_).columns[blob_column::CrossSection].unit, "m2");
}

TEST_F(SnapshotTest, columnsAreSeparateAndAsLongAsTheGroup)
{
    FrameSnapshot snapshot(&schema_, &memory_);
    write(snapshot, 5, 3, 2.5f);
    const SnapshotGroup& group = snapshot.group(0);
    EXPECT_EQ(group.column(blob_column::PositionX).size(), 3u);
    EXPECT_EQ(group.column(blob_column::PositionX)[2], 2.5f);
    EXPECT_EQ(group.column(blob_column::PositionY)[2], 0.0f);
    EXPECT_EQ(group.ids()[2], 2u);
    EXPECT_EQ(snapshot.tick(), 5);
}

TEST_F(SnapshotTest, theHashSeesEveryValueAndOnlyValues)
{
    FrameSnapshot a(&schema_, &memory_);
    FrameSnapshot b(&schema_, &memory_);
    write(a, 5, 3, 2.5f);
    write(b, 5, 3, 2.5f);
    EXPECT_EQ(a.hash(), b.hash());
    write(b, 5, 2, 2.5f);
    EXPECT_NE(a.hash(), b.hash());
    write(b, 5, 3, 2.25f);
    EXPECT_NE(a.hash(), b.hash());
    write(b, 6, 3, 2.5f);
    EXPECT_NE(a.hash(), b.hash());
}

TEST_F(SnapshotTest, writingTheSameShapeAgainAllocatesNothing)
{
    FrameSnapshot snapshot(&schema_, &memory_);
    write(snapshot, 1, 8, 0.0f);
    const uint64_t before = memory_.allocationCount();
    for (int i = 0; i < 10; ++i)
        write(snapshot, i, uint32_t(i % 8), 1.0f);
    EXPECT_EQ(memory_.allocationCount(), before);
}

TEST(FrameSnapshot, reusesTheMemoryOfGroupsWhateverTheirOrderWas)
{
    fx::base::HostMemory memory;
    fx::base::SnapshotSchema schema;
    const auto kind = schema.add(fx::base::kBlobKind);
    fx::base::FrameSnapshot snapshot(&schema, &memory);
    snapshot.begin(0, 1);
    for (const size_t capacity : {10, 400, 50})
        snapshot.addGroup(kind, capacity);
    const uint64_t before = memory.allocationCount();
    snapshot.begin(1, 2); // the first solver has ended: the others move up
    for (const size_t capacity : {400, 50})
        snapshot.addGroup(kind, capacity);
    EXPECT_EQ(memory.allocationCount(), before);
    EXPECT_EQ(snapshot.groupCount(), 2u);
}
