/// @file precision_dispatch.h
/// Macros for kernels that exist in float and in double, and that Highway compiles once for each instruction
/// set. Include this after hwy/foreach_target.h.
///
/// Highway's dispatch tables need the name of a function, which an instance of a template does not have. The
/// kernel is a template `RESULT KERNEL(const JOB<T>&)` of the target namespace. FX_KERNEL_INSTANCES, used in
/// the target namespace, defines a named function for each of the two instances of the kernel.
/// FX_KERNEL_DISPATCH, used where HWY_ONCE holds, defines both specializations of the declared template
/// `RESULT FUNCTION(const JOB<T>&)`. The specializations call the kernel for the instruction set in use.
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
