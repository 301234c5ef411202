/// @file every_set.h
/// Runs a test body once with each instruction set that the machine and FXSDK_SIMD allow.
#pragma once

#include "foundation/simd/instruction_set.h"

#include <gtest/gtest.h>

#include <vector>

namespace fx::test {

template <class F>
void everySet(F&& f)
{
    const base::InstructionSet widest = base::instructionSet();
    for (uint32_t set = 0; set <= uint32_t(widest); ++set) {
        base::limitInstructionSet(base::InstructionSet(set));
        SCOPED_TRACE(base::instructionSetName(base::InstructionSet(set)));
        f(base::InstructionSet(set));
    }
    base::limitInstructionSet(widest);
}

} // namespace fx::test
