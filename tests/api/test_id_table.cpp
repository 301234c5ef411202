#include "fxsdk/scene/id_table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <set>
#include <vector>

using fx::scene::IdCodec;
using fx::scene::IdTable;
using fx::scene::indexOf;
using fx::scene::kIdPartBits;
using fx::scene::kIdPartMask;
using fx::scene::LocalId;

TEST(IdTable, anIdFindsItsValueUntilTheValueIsRemoved)
{
    IdTable<int> table(std::pmr::get_default_resource(), 10);
    const LocalId a = table.add(11);
    const LocalId b = table.add(22);
    ASSERT_NE(a, 0u);
    EXPECT_EQ(*table.find(a), 11);
    table.remove(a);
    EXPECT_EQ(table.find(a), nullptr);
    EXPECT_EQ(*table.find(b), 22);
    EXPECT_EQ(table.find(0), nullptr);
    EXPECT_EQ(table.count(), 1u);
}

TEST(IdTable, theIndexThatWasFreedFirstIsUsedFirst)
{
    IdTable<int> table(std::pmr::get_default_resource(), 10);
    std::vector<LocalId> ids;
    for (int i = 0; i < 4; ++i)
        ids.push_back(table.add(i));
    for (const int i : {2, 0, 3})
        table.remove(ids[size_t(i)]);
    EXPECT_EQ(indexOf(table.add(0)), indexOf(ids[2]));
    EXPECT_EQ(indexOf(table.add(0)), indexOf(ids[0]));
    EXPECT_EQ(indexOf(table.add(0)), indexOf(ids[3]));
    EXPECT_EQ(indexOf(table.add(0)), 4u); // nothing free: a new index
}

TEST(IdTable, aFullTableTakesNothing)
{
    IdTable<int> table(std::pmr::get_default_resource(), 2);
    const LocalId a = table.add(1);
    table.add(2);
    EXPECT_EQ(table.add(3), 0u);
    table.remove(a);
    EXPECT_NE(table.add(3), 0u);
}

TEST(IdTable, anIndexWhoseUsesAreSpentIsRetiredSoThatNoIdComesBack)
{
    constexpr uint32_t kLastUse = 3;
    IdTable<int> table(std::pmr::get_default_resource(), 1, kLastUse);
    std::set<LocalId> seen;
    for (uint32_t i = 0; i < 4 * kLastUse; ++i) {
        const LocalId id = table.add(int(i));
        EXPECT_TRUE(seen.insert(id).second) << "identity " << id << " came back";
        EXPECT_EQ(indexOf(id), i / kLastUse);
        table.remove(id);
        EXPECT_EQ(table.find(id), nullptr);
    }
}

TEST(IdTable, anAdditionThatIsCancelledWasNever)
{
    // of a table that holds 1 and 2, and has had a 3: indices that are free, and none
    for (const bool hasFree : {false, true}) {
        const auto make = [hasFree] {
            IdTable<int> table(std::pmr::get_default_resource(), 10);
            table.add(1);
            table.add(2);
            if (hasFree)
                table.remove(table.add(3));
            return table;
        };
        IdTable<int> wanted = make(), table = make();
        for (int i = 0; i < 5; ++i)
            table.cancel(table.add(9));
        EXPECT_EQ(table.count(), 2u);
        for (int i = 0; i < 3; ++i) {
            const LocalId id = table.add(4 + i);
            EXPECT_EQ(id, wanted.add(4 + i));
            EXPECT_EQ(*table.find(id), 4 + i);
        }
        fx::sim::StateBuffer one(std::pmr::get_default_resource()), other(std::pmr::get_default_resource());
        table.save(one, [&](int value) { one.value(value); });
        wanted.save(other, [&](int value) { other.value(value); });
        EXPECT_TRUE(std::ranges::equal(one.bytes(), other.bytes()));
    }
}

TEST(IdTable, valuesTakeRoomForTheMostAtATime)
{
    struct Large
    {
        std::array<char, 1 << 16> bytes{};
    };
    /// The bytes of a table of so many indices that were all used once, and of which the last is in use.
    const auto stateOf = [](uint32_t indices) {
        fx::sim::StateBuffer state(std::pmr::get_default_resource());
        state.value(indices);
        for (uint32_t i = 0; i < indices; ++i) {
            state.value(uint32_t(1));
            state.flag(i + 1 == indices);
        }
        state.value(~0u); // none is free
        return state;
    };
    const fx::sim::StateBuffer state = stateOf(100'000); // 6 GiB of values
    IdTable<Large> table(std::pmr::get_default_resource(), 2);
    fx::sim::StateReader reader(state.bytes());
    table.restore(reader, [] { return Large{}; });
    EXPECT_TRUE(reader.ok()) << reader.status().message();
    EXPECT_EQ(table.count(), 1u);
    EXPECT_NE(table.find((uint64_t(1) << kIdPartBits) | 99'999), nullptr);
    EXPECT_EQ(indexOf(table.add({})), 100'000u);
}

TEST(IdTable, theGenerationsOfOneIndexLastForAllTheirTwentyFourBits)
{
    IdTable<char> table(std::pmr::get_default_resource(), 1);
    LocalId last = 0;
    for (uint64_t i = 0; i < kIdPartMask; ++i) {
        last = table.add(0);
        table.remove(last);
    }
    EXPECT_EQ(last, kIdPartMask << kIdPartBits); // index 0, last use
    EXPECT_EQ(indexOf(table.add(0)), 1u);
}

TEST(IdCodec, whatItEncodesItDecodesForEveryGenerationThatWraps)
{
    int owner = 0;
    const IdCodec codec(&owner);
    for (const uint64_t use : {uint64_t(1), uint64_t(2), kIdPartMask / 2, kIdPartMask - 1, kIdPartMask}) {
        const LocalId id = (use << kIdPartBits) | 5;
        EXPECT_EQ(codec.decode(codec.encode(id, 2), 2), id);
        EXPECT_EQ(codec.encode(id, 2) & kIdPartMask, 5u);
        EXPECT_EQ(codec.encode(id, 2) >> 56, 2u);
    }
}

TEST(IdCodec, anotherTypeIsRefusedAndSoIsTheNullId)
{
    int owner = 0;
    const IdCodec codec(&owner);
    const uint64_t id = codec.encode((uint64_t(1) << kIdPartBits) | 5, 2);
    EXPECT_EQ(codec.decode(id, 1), 0u);
    EXPECT_EQ(codec.decode(0, 2), 0u);
    EXPECT_EQ(codec.decode(0, 0), 0u);
}

TEST(IdCodec, theIdOfAnotherOwnerIsNeverTakenForTheFirstUse)
{
    std::vector<int> owners(1000);
    const IdCodec first(&owners[0]);
    const uint64_t id = first.encode(uint64_t(1) << kIdPartBits, 2);
    for (size_t i = 1; i < owners.size(); ++i)
        EXPECT_NE(IdCodec(&owners[i]).decode(id, 2), uint64_t(1) << kIdPartBits);
}
