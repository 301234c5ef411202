#include "foundation/simd/instruction_set.h"
#include "tests/foundation/every_set.h"

#include <gtest/gtest.h>

namespace {

using namespace fx;
using base::InstructionSet;

TEST(InstructionSet, namesAreThoseOfTheEnvironmentVariable)
{
    for (const char* name : {"scalar", "sse4", "avx2", "avx512"}) {
        const auto set = base::instructionSetOf(name);
        ASSERT_TRUE(set.has_value()) << name;
        EXPECT_EQ(base::instructionSetName(*set), name);
    }
    EXPECT_FALSE(base::instructionSetOf("mmx").has_value());
    EXPECT_FALSE(base::instructionSetOf("").has_value());
}

TEST(InstructionSet, isNeverWiderThanTheLimit)
{
    const InstructionSet widest = base::instructionSet();
    test::everySet([&](InstructionSet set) { EXPECT_EQ(base::instructionSet(), set); });
    EXPECT_EQ(base::instructionSet(), widest);
    base::limitInstructionSet(InstructionSet::Scalar);
    EXPECT_EQ(base::instructionSet(), InstructionSet::Scalar);
    base::limitInstructionSet(widest);
    EXPECT_EQ(base::instructionSet(), widest);
}

} // namespace
