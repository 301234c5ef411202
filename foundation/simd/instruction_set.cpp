#include "foundation/simd/instruction_set.h"

#include <hwy/targets.h>

#include <array>
#include <cstdlib>

namespace fx::base {

namespace {

constexpr std::array<std::string_view, 4> kNames{"scalar", "sse4", "avx2", "avx512"};

#if HWY_ARCH_X86
/// Highway's bits; better targets have lower ones.
constexpr std::array<int64_t, 4> kTargets{HWY_EMU128, HWY_SSE4, HWY_AVX2, HWY_AVX3};
#endif

void disableBeyond(InstructionSet widest)
{
#if HWY_ARCH_X86
    hwy::DisableTargets(widest == InstructionSet::Avx512 ? 0 : kTargets[size_t(widest)] - 1);
    // SupportedTargets() respects the choice, but a call of it resets the choice, except while a test value
    // is set.
    hwy::SetSupportedTargetsForTest(0);
    const int64_t allowed = hwy::SupportedTargets();
    hwy::SetSupportedTargetsForTest(allowed);
    hwy::GetChosenTarget().Update(allowed);
#else
    (void)widest; // other processors have one set
#endif
}

/// The environment variable, read once.
struct Environment
{
    Environment()
    {
        const char* value = std::getenv("FXSDK_SIMD");
        if (!value || !*value)
            return;
        if (const auto set = instructionSetOf(value))
            disableBeyond(*set);
        else
            note = "FXSDK_SIMD is none of scalar, sse4, avx2, avx512 and was ignored";
    }
    std::string_view note;
};

const Environment& environment()
{
    static const Environment read;
    return read;
}

} // namespace

std::string_view instructionSetName(InstructionSet set)
{
    return kNames[size_t(set)];
}

std::optional<InstructionSet> instructionSetOf(std::string_view name)
{
    for (size_t i = 0; i < kNames.size(); ++i)
        if (kNames[i] == name)
            return InstructionSet(i);
    return std::nullopt;
}

void applyInstructionSetLimit()
{
    environment();
}

std::string_view instructionSetNote()
{
    return environment().note;
}

InstructionSet instructionSet()
{
    applyInstructionSetLimit();
#if HWY_ARCH_X86
    const int64_t supported = hwy::SupportedTargets();
    for (size_t i = kTargets.size() - 1; i > 0; --i)
        if (supported & kTargets[i])
            return InstructionSet(i);
#endif
    return InstructionSet::Scalar;
}

void limitInstructionSet(InstructionSet widest)
{
    applyInstructionSetLimit(); // so that the environment does not overrule it later
    disableBeyond(widest);
}

} // namespace fx::base
