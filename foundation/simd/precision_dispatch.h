/// @file precision_dispatch.h
/// Entry points of kernels that exist in float and in double and that Highway compiles once for each
/// instruction set. Included after hwy/foreach_target.h.
///
/// Highway's tables take names of functions, and instances of a template have none. For a kernel that is a
/// template `RESULT KERNEL(const JOB<T>&)` of the target namespace, FX_KERNEL_INSTANCES names the instances,
/// in the target namespace, and FX_KERNEL_DISPATCH defines, where HWY_ONCE holds, both specializations of the
/// declared template `RESULT FUNCTION(const JOB<T>&)`, which call the kernel of the instruction set in use.
#pragma once

#include "foundation/simd/instruction_set.h"

#define FX_KERNEL_INSTANCES(RESULT, KERNEL, JOB)                                                             \
    RESULT KERNEL##Floats(const JOB<float>& job)                                                             \
    {                                                                                                        \
        return KERNEL(job);                                                                                  \
    }                                                                                                        \
    RESULT KERNEL##Doubles(const JOB<double>& job)                                                           \
    {                                                                                                        \
        return KERNEL(job);                                                                                  \
    }

#define FX_KERNEL_DISPATCH(RESULT, FUNCTION, KERNEL, JOB)                                                    \
    namespace {                                                                                              \
    HWY_EXPORT(KERNEL##Floats);                                                                              \
    HWY_EXPORT(KERNEL##Doubles);                                                                             \
    }                                                                                                        \
    template <>                                                                                              \
    RESULT FUNCTION(const JOB<float>& job)                                                                   \
    {                                                                                                        \
        fx::base::applyInstructionSetLimit();                                                                \
        return HWY_DYNAMIC_DISPATCH(KERNEL##Floats)(job);                                                    \
    }                                                                                                        \
    template <>                                                                                              \
    RESULT FUNCTION(const JOB<double>& job)                                                                  \
    {                                                                                                        \
        fx::base::applyInstructionSetLimit();                                                                \
        return HWY_DYNAMIC_DISPATCH(KERNEL##Doubles)(job);                                                   \
    }
