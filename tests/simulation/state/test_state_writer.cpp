#include "foundation/memory/host_memory.h"
#include "simulation/state/state_writer.h"

#include <gtest/gtest.h>

#include <array>

using namespace fx;

namespace {

enum class Shade : uint8_t
{
    Dark = 3
};

template <class T>
concept Writable = sim::StateValue<T>;

struct Padded
{
    uint8_t a;
    uint32_t b;
};

/// Writes the same to any writer.
void writeAll(sim::StateWriter& writer)
{
    writer.value(uint32_t(0x04030201));
    writer.flag(true);
    writer.value(Shade::Dark);
    writer.vector(glm::vec3(1.0f, 2.0f, 3.0f));
    writer.block(std::array{std::byte{9}, std::byte{8}});
}

} // namespace

TEST(StateWriter, writesValuesWithoutGaps)
{
    base::HostMemory memory;
    sim::StateBuffer buffer(&memory);
    writeAll(buffer);
    ASSERT_EQ(buffer.bytes().size(), 4u + 1 + 1 + 12 + 8 + 2);
    const std::array first{std::byte{1}, std::byte{2}, std::byte{3},
                           std::byte{4}, std::byte{1}, std::byte{3}};
    EXPECT_TRUE(std::equal(first.begin(), first.end(), buffer.bytes().begin()));
    EXPECT_EQ(buffer.bytes().back(), std::byte{8});
}

TEST(StateWriter, takesOnlyTypesWhoseEveryBitIsPartOfTheValue)
{
    static_assert(Writable<float> && Writable<uint64_t> && Writable<Shade> && Writable<std::byte>);
    static_assert(!Writable<Padded>);       // has uninitialized padding
    static_assert(!Writable<const float*>); // an address differs from run to run
    static_assert(!Writable<bool>);         // other values than 0 and 1 could be read back: see flag()
    static_assert(!Writable<long double>);  // 10 of 16 bytes
}

TEST(StateWriter, hashesAgreeForEqualStatesAndDifferForOthers)
{
    sim::StateHasher a, b, c;
    writeAll(a);
    writeAll(b);
    writeAll(c);
    EXPECT_EQ(a.hash(), b.hash());
    c.value(uint8_t(0));
    EXPECT_NE(a.hash(), c.hash());
    sim::StateHasher positive, negative;
    positive.value(0.0f);
    negative.value(-0.0f);
    EXPECT_NE(positive.hash(), negative.hash()); // equal numbers, but not equal bits
}
