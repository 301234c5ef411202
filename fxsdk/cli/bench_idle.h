/// @file bench_idle.h
/// fx bench idle: what a frame costs in which nothing is to be seen.
#pragma once

#include <cstdint>

namespace fx::cli {

struct BenchIdleOptions
{
    uint32_t dormant = 0;  ///< instances before their start
    uint32_t hidden = 0;   ///< instances behind the camera
    bool gl = false;       ///< a view draws each frame as well
    bool turn = false;     ///< the camera moves each frame
    bool visitAll = false; ///< asks every instance for its state in each frame: the control of the gates
    bool check = false;    ///< compares the costs of few and many against the gates
    bool json = false;
    bool countWork = false; ///< runs the frames that callgrind counts, and prints nothing
};

/// @return exit code: 0, or 1 when a gate is broken or nothing could be measured
int runBenchIdle(const BenchIdleOptions& options);

} // namespace fx::cli
