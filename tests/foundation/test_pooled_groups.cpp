#include "foundation/memory/host_memory.h"
#include "foundation/snapshot/frame_snapshot.h"
#include "foundation/snapshot/particle_kind.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

using namespace fx::base;

namespace {

namespace particle = particle_column;

constexpr ColumnSet kPresent = particle::kAlways | particle::kAngle;
constexpr uint32_t kEach = 20;
constexpr uint32_t kMembers = 9;
constexpr uint64_t kConstants = 77;

/// The rows of a member: every third is empty.
struct Row
{
    uint32_t member, place;

    bool isEmpty() const { return place % 3 == 2; }
    void write(SnapshotGroup& to, size_t at) const
    {
        for (size_t c = 0; c < particle::Count; ++c) {
            if (!to.has(c))
                continue;
            const uint32_t value = isEmpty() ? 0 : 1 + member * 1000 + place * 20 + uint32_t(c);
            if (kParticleColumns[c].type == ColumnType::F32)
                to.editColumn(c)[at] = float(value);
            else
                to.editColumn64(c)[at] = uint64_t(value) << 33;
        }
    }
    Bounds bounds(float corner) const
    {
        const auto value = [this](size_t c) { return float(1 + member * 1000 + place * 20 + c); };
        Bounds box;
        box.add({value(particle::PositionX), value(particle::PositionY), value(particle::PositionZ)},
                value(particle::Radius) * corner);
        return box;
    }
};

uint32_t rowsOf(uint32_t member)
{
    return kEach - member;
}

class PooledGroups : public testing::Test
{
protected:
    void fillInfo(SnapshotGroup& group, uint32_t member)
    {
        group.editInfo().instance = 100 + member;
        group.editInfo().solver = member % 2;
        group.editInfo().count = rowsOf(member);
        group.editInfo().placement.position.x = double(member);
        group.editInfo().isCosmetic = member == 3;
    }
    void fillConstants(SnapshotGroup& group)
    {
        if (!group.keepsConstants(kConstants))
            group.editConstants()[particle_constant::Luminance] = 5.0f;
    }
    void addOther(FrameSnapshot& snapshot, uint32_t number)
    {
        SnapshotGroup& group = snapshot.addGroup(kind_, 3, kPresent);
        group.editInfo().instance = number;
        group.editInfo().count = 1;
        Row{50 + number, 0}.write(group, 0);
    }
    /// Members one after another with other groups before the third and at the end.
    void addOneByOne(FrameSnapshot& snapshot)
    {
        for (uint32_t m = 0; m < kMembers; ++m) {
            if (m == 3)
                addOther(snapshot, 1);
            SnapshotGroup& group = snapshot.addGroupAgain(kind_, kEach, kPresent);
            fillInfo(group, m);
            fillConstants(group);
            for (uint32_t place = 0; place < kEach; ++place)
                Row{m, place}.write(group, place);
        }
        addOther(snapshot, 2);
    }
    /// The same as a pool whose rows go around its end, the last born of all members first.
    void addPooled(FrameSnapshot& snapshot)
    {
        addOther(snapshot, 1);
        addOther(snapshot, 2);
        const uint32_t capacity = kMembers * kEach + 40;
        PooledRows& pool = snapshot.addPool(kind_, capacity, kPresent, kEach);
        fillConstants(pool.rows);
        pool.number = kConstants;
        pool.radiusColumn = particle::Radius;
        pool.corner = 1.5f;
        pool.counts.clear();
        uint32_t at = capacity - 50;
        pool.used[1] = {at, capacity};
        for (uint32_t place = kEach; place-- > 0;)
            for (uint32_t m = 0; m < kMembers; ++m) {
                if (place >= rowsOf(m))
                    continue;
                Row{m, place}.write(pool.rows, at);
                pool.owner[at] = PooledRows::nameOf(m, place);
                at = at + 1 == capacity ? 0 : at + 1;
            }
        pool.used[0] = {0, at};
        for (uint32_t m = 0; m < kMembers; ++m) {
            pool.counts.push_back(rowsOf(m));
            const GroupRoster::Entry entry{
                100 + m, {glm::dvec3(double(m), 0.0, 0.0)}, m % 2, 0, m, m < 3 ? 0u : 1u, m == 3};
            roster_->entries.push_back(entry);
        }
        roster_->shape = 1;
        snapshot.setRoster(roster_, std::array{1u, 2u});
    }

    HostMemory memory_;
    SnapshotSchema schema_;
    KindId kind_ = schema_.add(kParticleKind);
    std::shared_ptr<GroupRoster> roster_ = std::make_shared<GroupRoster>();
    FrameSnapshot plain_{&schema_, &memory_};
    FrameSnapshot pooled_{&schema_, &memory_};
};

} // namespace

TEST_F(PooledGroups, readLikeGroupsThatWereAddedOneByOne)
{
    plain_.begin(5, 1);
    addOneByOne(plain_);
    pooled_.begin(5, 1);
    addPooled(pooled_);
    EXPECT_EQ(pooled_.addedCount(), 2u);
    ASSERT_EQ(pooled_.groupCount(), plain_.groupCount());
    for (size_t g = 0; g < plain_.groupCount(); ++g) {
        const SnapshotGroup& a = plain_.group(g);
        const SnapshotGroup& b = pooled_.group(g);
        EXPECT_EQ(a.info().instance, b.info().instance);
        EXPECT_EQ(a.info().solver, b.info().solver);
        EXPECT_EQ(a.info().isCosmetic, b.info().isCosmetic);
        EXPECT_EQ(a.info().placement.position, b.info().placement.position);
        EXPECT_TRUE(std::ranges::equal(a.constants(), b.constants()));
        for (size_t c = 0; c < particle::Count; ++c) {
            EXPECT_TRUE(std::ranges::equal(a.column(c), b.column(c))) << g << ' ' << c;
            if (kParticleColumns[c].type == ColumnType::U64) {
                EXPECT_TRUE(std::ranges::equal(a.column64(c), b.column64(c))) << g << ' ' << c;
            }
            EXPECT_EQ(reinterpret_cast<uintptr_t>(b.column(c).data()) % 64, 0u);
        }
    }
}

TEST_F(PooledGroups, haveTheHashOfGroupsThatWereAddedWhetherSomebodyHasReadThemOrNot)
{
    plain_.begin(5, 1);
    addOneByOne(plain_);
    pooled_.begin(5, 1);
    addPooled(pooled_);
    EXPECT_EQ(pooled_.hash(), plain_.hash());
    EXPECT_EQ(pooled_.group(4).info().instance, 103u);
    EXPECT_EQ(pooled_.hash(), plain_.hash());
}

TEST_F(PooledGroups, areBoundedByTheirRows)
{
    pooled_.begin(5, 1);
    addPooled(pooled_);
    for (size_t g = 0; g < 3; ++g) {
        const Bounds& bounds = pooled_.group(g).info().bounds;
        const float reach = 1.5f * float(1 + g * 1000 + 20 * (rowsOf(uint32_t(g)) - 1) + particle::Radius);
        const Bounds first = Row{uint32_t(g), 0}.bounds(1.5f);
        EXPECT_LE(bounds.min.x, first.min.x);
        EXPECT_GE(bounds.max.x, first.max.x);
        EXPECT_GE(bounds.max.x - bounds.min.x, reach);
    }
}

TEST_F(PooledGroups, anotherPublicationIsNotThatOfTheOneBefore)
{
    pooled_.begin(5, 1);
    addPooled(pooled_);
    EXPECT_EQ(pooled_.group(0).info().instance, 100u);
    pooled_.begin(6, 2);
    EXPECT_EQ(pooled_.groupCount(), 0u);
    addOther(pooled_, 9);
    ASSERT_EQ(pooled_.groupCount(), 1u);
    EXPECT_EQ(pooled_.group(0).info().instance, 9u);
    roster_->entries.clear();
    pooled_.begin(7, 3);
    addPooled(pooled_);
    EXPECT_EQ(pooled_.group(0).info().instance, 100u);
    EXPECT_EQ(pooled_.group(3).info().instance, 1u);
}

TEST_F(PooledGroups, readingThemAgainAndAgainAllocatesNothing)
{
    uint64_t before = 0;
    for (int i = 0; i < 6; ++i) {
        roster_->entries.clear();
        pooled_.begin(i, uint64_t(i) + 1);
        addPooled(pooled_);
        if (i == 1)
            before = memory_.allocationCount();
        static_cast<void>(i % 2 ? pooled_.hash() : pooled_.group(2).count());
    }
    EXPECT_EQ(memory_.allocationCount(), before);
}

TEST_F(PooledGroups, areNamedAndFoundInTheirPoolsWithoutBeingGivenTheirRows)
{
    plain_.begin(5, 1);
    addOneByOne(plain_);
    pooled_.begin(5, 1);
    addPooled(pooled_);
    ASSERT_EQ(pooled_.groupCount(), plain_.groupCount());
    for (size_t g = 0; g < plain_.groupCount(); ++g) {
        EXPECT_EQ(pooled_.name(g), plain_.name(g)) << g;
        EXPECT_EQ(plain_.pooled(g), nullptr);
        const GroupRoster::Entry* const entry = pooled_.pooled(g);
        ASSERT_EQ(entry != nullptr, g != 3 && g != kMembers + 1) << g;
        if (!entry) {
            EXPECT_EQ(pooled_.group(g).count(), 1u); // one that was added is read by itself
            continue;
        }
        EXPECT_EQ(entry->member, g < 3 ? g : g - 1);
    }
    EXPECT_FALSE(pooled_.hasGivenRows());
    EXPECT_EQ(pooled_.group(0).info().instance, 100u);
    EXPECT_TRUE(pooled_.hasGivenRows());
}

TEST_F(PooledGroups, standElsewhereWhereOthersHaveComeBetween)
{
    for (const uint32_t others : {1u, 2u, 1u}) {
        roster_->entries.clear();
        pooled_.begin(5, 1);
        addPooled(pooled_); // with two others
        const std::array ends{others, 2u};
        pooled_.setRoster(roster_, ends);
        EXPECT_EQ(pooled_.pooled(3), nullptr);
        EXPECT_EQ(pooled_.pooled(4) == nullptr, others == 2) << others;
        EXPECT_EQ(pooled_.name(pooled_.groupCount() - 1).instance, others == 2 ? 108u : 2u);
    }
}
