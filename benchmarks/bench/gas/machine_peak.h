/// @file machine_peak.h
/// Measured peak performance of the machine, for comparison with kernels.
#pragma once

#include <cstddef>

namespace fx::cli {

struct MachinePeak
{
    double floatFlops;  ///< [1/s] multiplications and additions of floats, not fused, by one thread
    double doubleFlops; ///< [1/s]
    double nearBytes;   ///< [B/s] repeated reading of 1 MiB by one thread
    double farBytes;    ///< [B/s] reading of 256 MiB by one thread
};

/// Measures the peak performance with the widest instruction set that is allowed now
/// (foundation/simd/instruction_set.h). Returns the best of several runs, which take about half a second.
MachinePeak measureMachinePeak();

} // namespace fx::cli
