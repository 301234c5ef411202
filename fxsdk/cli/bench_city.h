/// @file bench_city.h
/// fx bench city: ten thousand effects of which a camera sees fifty, against a scene that has only those.
#pragma once

#include <cstdint>

namespace fx::cli {

struct BenchCityOptions
{
    uint32_t instances = 10'000;
    uint32_t frames = 240;
    bool gl = false; ///< draw each frame as well
    bool json = false;
};

/// @return exit code
int runBenchCity(const BenchCityOptions& options);

} // namespace fx::cli
