#include "foundation/memory/host_memory.h"
#include "simulation/state/state_reader.h"

#include <gtest/gtest.h>

#include <array>
#include <limits>

using namespace fx;

namespace {

struct StateReader : ::testing::Test
{
    base::HostMemory memory;
    sim::StateBuffer buffer{&memory};
};

} // namespace

TEST_F(StateReader, readsBackWhatWasWritten)
{
    const std::array numbers{1.5f, -2.0f, 0.0f};
    buffer.value(int64_t(-7));
    buffer.flag(true);
    buffer.vector(glm::vec3(1, 2, 3));
    buffer.vector(glm::dvec3(1e300, 5, 6));
    buffer.rotation(glm::quat(0.1f, 0.2f, 0.3f, 0.4f));
    buffer.values(std::span<const float>(numbers));
    buffer.block(std::array{std::byte{4}});
    sim::StateReader reader(buffer.bytes());
    EXPECT_EQ(reader.value<int64_t>(), -7);
    EXPECT_TRUE(reader.flag());
    EXPECT_EQ(reader.vector(), glm::vec3(1, 2, 3));
    EXPECT_EQ(reader.doubleVector(), glm::dvec3(1e300, 5, 6));
    EXPECT_EQ(reader.rotation(), glm::quat(0.1f, 0.2f, 0.3f, 0.4f));
    std::array<float, 3> read{};
    reader.values(std::span<float>(read));
    EXPECT_EQ(read, numbers);
    const std::span<const std::byte> block = reader.block();
    ASSERT_EQ(block.size(), 1u);
    EXPECT_EQ(block[0], std::byte{4});
    EXPECT_TRUE(reader.ok());
    EXPECT_EQ(reader.left(), 0u);
}

TEST_F(StateReader, aStateThatEndsEarlyFailsAndReadsAsZeroFromThereOn)
{
    buffer.value(uint32_t(0xFFFFFFFF));
    sim::StateReader reader(buffer.bytes());
    EXPECT_EQ(reader.value<uint64_t>(), 0u);
    EXPECT_FALSE(reader.ok());
    EXPECT_EQ(reader.status().code(), base::Code::Parse);
    EXPECT_EQ(reader.value<uint32_t>(), 0u); // although four bytes are left
    EXPECT_TRUE(reader.block().empty());
}

TEST_F(StateReader, theFirstFailureIsTheOneThatIsReported)
{
    buffer.value(uint32_t(5));
    sim::StateReader reader(buffer.bytes());
    EXPECT_EQ(reader.value<uint32_t>(1, 4, "first"), 1u);
    reader.require(false, "second");
    reader.fail({base::Code::NotFound, "third"});
    EXPECT_EQ(reader.status().message(), "first");
}

TEST_F(StateReader, limitsAreInclusiveAndNoNumberIsOutside)
{
    for (const float x : {1.0f, 2.0f, 0.99f, 2.01f, std::numeric_limits<float>::quiet_NaN()}) {
        sim::StateBuffer one(&memory);
        one.value(x);
        sim::StateReader reader(one.bytes());
        reader.value<float>(1.0f, 2.0f, "outside");
        EXPECT_EQ(reader.ok(), x >= 1.0f && x <= 2.0f) << x;
    }
}

TEST_F(StateReader, numbersThatAreNotFiniteAreRefused)
{
    for (const double x : {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()})
    {
        sim::StateBuffer one(&memory);
        one.vector(glm::dvec3(0, x, 0));
        sim::StateReader reader(one.bytes());
        reader.doubleVector();
        EXPECT_FALSE(reader.ok());
    }
}

TEST_F(StateReader, aFlagIsZeroOrOne)
{
    buffer.value(uint8_t(2));
    sim::StateReader reader(buffer.bytes());
    reader.flag();
    EXPECT_FALSE(reader.ok());
}

TEST_F(StateReader, aBlockLongerThanTheStateIsRefused)
{
    buffer.value(std::numeric_limits<uint64_t>::max());
    sim::StateReader reader(buffer.bytes());
    EXPECT_TRUE(reader.block().empty());
    EXPECT_FALSE(reader.ok());
}
