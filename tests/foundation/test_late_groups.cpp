// Groups of a snapshot whose rows are computed when they are first read.
#include "foundation/snapshot/blob_kind.h"
#include "foundation/snapshot/frame_snapshot.h"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>
#include <vector>

using namespace fx;

namespace {

namespace blob = base::blob_column;

std::atomic<int> fills{0};

/// Twice the places of the group before.
void doubled(const base::FrameSnapshot& snapshot, size_t place, base::SnapshotGroup& io)
{
    ++fills;
    for (size_t i = 0; i < io.count(); ++i)
        io.editColumn(blob::PositionX)[i] = 2.0f * snapshot.added(place - 1).column(blob::PositionX)[i];
}

class LateGroups : public testing::Test
{
protected:
    void SetUp() override
    {
        kind_ = schema_.add(base::kBlobKind);
        fills = 0;
        write(3.0f);
    }
    void write(float x)
    {
        snapshot_.begin(7, 1);
        base::SnapshotGroup& source = snapshot_.addGroup(kind_, 2);
        source.editInfo().count = 2;
        source.editColumn(blob::PositionX)[0] = x;
        source.editColumn(blob::PositionX)[1] = x + 1.0f;
        base::SnapshotGroup& late = snapshot_.addLateGroup(kind_, doubled);
        late.editInfo().count = 2;
        late.editInfo().isLate = true;
        late.editConstants()[base::blob_constant::Layer] = 2.0f;
    }

    base::SnapshotSchema schema_;
    base::KindId kind_ = 0;
    base::FrameSnapshot snapshot_{&schema_, std::pmr::get_default_resource()};
};

} // namespace

TEST_F(LateGroups, areComputedWhenTheyAreFirstReadAndOnce)
{
    EXPECT_EQ(snapshot_.groupCount(), 2u);
    EXPECT_EQ(snapshot_.name(1).kind, kind_);
    EXPECT_EQ(snapshot_.added(1).info().count, 2u);
    EXPECT_EQ(fills, 0);
    EXPECT_EQ(snapshot_.group(1).column(blob::PositionX)[1], 8.0f);
    EXPECT_EQ(snapshot_.group(1).constants()[base::blob_constant::Layer], 2.0f);
    EXPECT_EQ(fills, 1);
}

TEST_F(LateGroups, areComputedAnewForEachPublication)
{
    EXPECT_EQ(snapshot_.group(1).column(blob::PositionX)[0], 6.0f);
    write(5.0f);
    EXPECT_EQ(snapshot_.group(1).column(blob::PositionX)[0], 10.0f);
    EXPECT_EQ(fills, 2);
}

TEST_F(LateGroups, areNoPartOfTheHashWhichDoesNotComputeThem)
{
    const uint64_t hash = snapshot_.hash();
    EXPECT_EQ(fills, 0);
    static_cast<void>(snapshot_.group(1));
    EXPECT_EQ(snapshot_.hash(), hash);
    write(5.0f);
    EXPECT_NE(snapshot_.hash(), hash); // because of the group that they are computed from
}

TEST_F(LateGroups, areComputedOnceForManyThreads)
{
    for (int round = 1; round <= 20; ++round) {
        write(float(round));
        std::vector<std::thread> readers;
        std::atomic<int> wrong{0};
        for (int t = 0; t < 4; ++t)
            readers.emplace_back([&] {
                if (snapshot_.group(1).column(blob::PositionX)[1] != 2.0f * float(round + 1))
                    ++wrong;
            });
        for (std::thread& reader : readers)
            reader.join();
        EXPECT_EQ(wrong, 0);
        EXPECT_EQ(fills, round);
    }
}
