#include "foundation/memory/host_memory.h"
#include "foundation/snapshot/blob_kind.h"
#include "foundation/snapshot/frame_snapshot.h"
#include "foundation/snapshot/particle_kind.h"

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

namespace {

namespace particle = fx::base::particle_column;

/// A group of three particles of the kind that has columns of both types.
fx::base::SnapshotGroup& addParticles(fx::base::FrameSnapshot& snapshot, fx::base::KindId kind,
                                      fx::base::ColumnSet present)
{
    snapshot.begin(7, 1);
    auto& group = snapshot.addGroup(kind, 3, present);
    group.editInfo().count = 3;
    for (size_t c = 0; c < particle::Count; ++c) {
        std::ranges::fill(fx::base::kParticleColumns[c].type == fx::base::ColumnType::F32
                              ? group.editColumn(c)
                              : std::span<float>(),
                          float(c));
        if (fx::base::kParticleColumns[c].type == fx::base::ColumnType::U64)
            std::ranges::fill(group.editColumn64(c), uint64_t(c) << 40);
    }
    return group;
}

} // namespace

TEST(FrameSnapshot, keepsColumnsOf64BitsAndLeavesOutThoseThatAreNotWanted)
{
    fx::base::HostMemory memory;
    fx::base::SnapshotSchema schema;
    const auto kind = schema.add(fx::base::kParticleKind);
    fx::base::FrameSnapshot snapshot(&schema, &memory);
    const auto& group = addParticles(snapshot, kind, particle::kAlways | particle::kIndex);

    EXPECT_TRUE(group.ids().empty());
    EXPECT_FALSE(group.has(particle::Angle));
    EXPECT_TRUE(group.column(particle::Angle).empty());
    ASSERT_EQ(group.column64(particle::Color).size(), 3u);
    for (size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(group.column(particle::Radius)[i], float(particle::Radius));
        EXPECT_EQ(group.column64(particle::Color)[i], uint64_t(particle::Color) << 40);
        EXPECT_EQ(group.column64(particle::Index)[i], uint64_t(particle::Index) << 40);
    }
    for (size_t c = 0; c < particle::Count; ++c)
        EXPECT_EQ(reinterpret_cast<uintptr_t>(group.column(c).data()) % 64, 0u);
}

TEST(FrameSnapshot, itsHashCoversColumnsOf64Bits)
{
    fx::base::HostMemory memory;
    fx::base::SnapshotSchema schema;
    const auto kind = schema.add(fx::base::kParticleKind);
    fx::base::FrameSnapshot snapshot(&schema, &memory);
    auto& group = addParticles(snapshot, kind, particle::kAlways);
    const uint64_t before = snapshot.hash();
    group.editColumn64(particle::Color)[2] ^= uint64_t(1) << 63;
    EXPECT_NE(snapshot.hash(), before);
}

TEST_F(SnapshotTest, constantsStayForTheirWriterAndForNobodyElse)
{
    FrameSnapshot snapshot(&schema_, &memory_);
    const auto groupOf = [&](ColumnSet present) -> SnapshotGroup& {
        snapshot.begin(1, 1);
        return snapshot.addGroupAgain(kind_, 8, present);
    };
    SnapshotGroup& first = groupOf(kAllColumns);
    EXPECT_FALSE(first.keepsConstants(7));
    first.editConstants()[0] = 3.0f;
    EXPECT_TRUE(groupOf(kAllColumns).keepsConstants(7));
    EXPECT_EQ(snapshot.group(0).constants()[0], 3.0f);
    EXPECT_FALSE(groupOf(kAllColumns).keepsConstants(8)); // another writer
    EXPECT_EQ(snapshot.group(0).constants()[0], 0.0f);
    EXPECT_TRUE(groupOf(kAllColumns).keepsConstants(8));
    snapshot.begin(2, 2);
    snapshot.addGroup(kind_, 8); // one that writes all of them each time
    EXPECT_FALSE(groupOf(kAllColumns).keepsConstants(8));
    EXPECT_FALSE(groupOf(1).keepsConstants(8)); // other columns
}
