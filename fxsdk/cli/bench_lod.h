/// @file bench_lod.h
/// fx bench lod: a field of far effects with and without a level of detail.
#pragma once

#include <cstdint>

namespace fx::cli {

struct BenchLodOptions
{
    uint32_t instances = 1000;
    int pixels = 512;      ///< width and height of the picture
    uint32_t repeats = 12; ///< frames of which the mean time is taken
    uint32_t flight = 48;  ///< frames
    bool json = false;
    bool check = false; ///< fail when a change of level is seen, or when the control's are not
};

/// @return exit code
int runBenchLod(const BenchLodOptions& options);

} // namespace fx::cli
