/// @file bench_soak.h
/// fx bench soak: nothing grows with the time that a scene has been running.
#pragma once

#include <cstdint>

namespace fx::cli {

struct BenchSoakOptions
{
    uint32_t frames = 100'000;
    bool gl = false;   ///< draw each frame as well
    bool leak = false; ///< leaves an instance behind each round: the control of the gates
    bool check = false;
    bool json = false;
    bool countWork = false; ///< runs the frames that callgrind counts, and prints nothing
};

/// @return exit code: 0, or 1 when a gate is broken or nothing could be measured
int runBenchSoak(const BenchSoakOptions& options);

} // namespace fx::cli
