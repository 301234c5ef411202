/// @file calibration.h
/// Present speed of the machine, by which times of different machines and days can be compared.
#pragma once

#include <nlohmann/json.hpp>

namespace fx::cli {

struct Calibration
{
    /// [ns] time of one step in a chain of dependent multiplications and additions
    double multiplyAddNanoseconds = 0;
    double copyGigabytes = 0; ///< [GB/s] bandwidth, read and written, of a copy much larger than the caches
};

/// Measures the speed on the calling thread in about 50 ms.
Calibration calibrate();

/// Converts the calibration to the member "calibration" of a --json line.
nlohmann::json toJson(const Calibration& calibration);

} // namespace fx::cli
