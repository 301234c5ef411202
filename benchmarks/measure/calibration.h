/// @file calibration.h
/// How fast the machine is at this moment, so that times of different machines and days can be compared.
#pragma once

#include <nlohmann/json.hpp>

namespace fx::cli {

struct Calibration
{
    double multiplyAddNanoseconds = 0; ///< [ns] of one step of a chain of multiplications and additions
    double copyGigabytes = 0;          ///< [GB/s] read and written by a copy far beyond the caches
};

/// Takes about 50 ms on the calling thread.
Calibration calibrate();

/// Member "calibration" of a --json line.
nlohmann::json toJson(const Calibration& calibration);

} // namespace fx::cli
