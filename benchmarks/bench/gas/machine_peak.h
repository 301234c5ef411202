/// @file machine_peak.h
/// Measured peak performance of the machine, to which kernels are compared.
#pragma once

#include <cstddef>

namespace fx::cli {

struct MachinePeak
{
    double floatFlops;  ///< [1/s] multiplications and additions of floats, not fused, of one thread
    double doubleFlops; ///< [1/s]
    double nearBytes;   ///< [B/s] read by one thread from 1 MiB that it has just read
    double farBytes;    ///< [B/s] from 256 MiB
};

/// With the widest instruction set that is allowed now (foundation/simd/instruction_set.h); the best of
/// several runs, about half a second.
MachinePeak measureMachinePeak();

} // namespace fx::cli
