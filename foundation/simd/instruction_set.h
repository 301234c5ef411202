/// @file instruction_set.h
/// The vector instructions that the simulation uses. All instruction sets give the same bits, but differ in
/// speed.
///
/// Kernels are compiled once for each instruction set with Highway and chosen at run time. Call
/// applyInstructionSetLimit() before HWY_DYNAMIC_DISPATCH: the first call of the process reads FXSDK_SIMD.
/// Highway stores the limit once per loaded copy of its library: a host that uses the same copy shares the
/// limit.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace fx::base {

/// Instruction sets in order of their vector width.
enum class InstructionSet : uint8_t
{
    Scalar, ///< baseline of the architecture, without vectors
    Sse4,
    Avx2,
    Avx512
};

/// Name of an instruction set, as used in FXSDK_SIMD: scalar, sse4, avx2, avx512.
std::string_view instructionSetName(InstructionSet set);
std::optional<InstructionSet> instructionSetOf(std::string_view name);

/// Limits the instruction set to the value of the environment variable FXSDK_SIMD; an unknown value is
/// ignored. Only the first call in a process has an effect. Cheap and thread-safe.
void applyInstructionSetLimit();
/// Warning about the environment variable FXSDK_SIMD; empty if the variable is unset or valid.
std::string_view instructionSetNote();

/// The instruction set in use: the widest instruction set that both the processor and the limit allow.
InstructionSet instructionSet();

/// Replaces the limit of instruction sets. Tests and benchmarks use this function. It must not be called
/// while kernels run.
void limitInstructionSet(InstructionSet widest);

} // namespace fx::base
