/// @file bench_row.h
/// Measurements of fx bench that count elements: variants, rows of results, and common options.
#pragma once

#include "benchmarks/bench/bench_measurement.h"
#include "foundation/result/status.h"

#include <nlohmann/json.hpp>

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace fx::cli {

/// Options of the command line.
struct BenchSettings
{
    uint64_t count = 0;   ///< number of elements; 0: BenchEntry::usualCount
    uint32_t threads = 1; ///< number of threads; 0: as many as the machine supports
    uint32_t steps = 0;   ///< number of timed steps; 0: enough for about a second
    std::string variant;  ///< name of the variant to measure; empty: all variants of the entry
    bool gpu = false;     ///< true: particles are computed on the GPU if possible
    bool gl = false;      ///< true: a view draws each frame as well
};

/// One measurement.
struct BenchRow
{
    std::string name;
    std::string variant;
    uint64_t count = 0;
    double medianNanoseconds = 0; ///< [ns] median time per particle and step
    double p95Nanoseconds = 0;    ///< [ns] 95th percentile of the time per particle and step
    /// [byte] bytes read and written by a step; for `fx bench frame`: bytes uploaded
    double bytesPerParticle = 0;
    /// [1] fraction of the bandwidth of a copy of the same size with the same threads; 0: unknown.
    double bandwidthFraction = 0;
    /// Hash of all published or sorted data; for `fx bench frame`: hash of the simulation.
    uint64_t hash = 0;
    nlohmann::json more; ///< further members of the JSON line
};

struct BenchEntry
{
    std::string_view name;
    std::string_view summary;
    std::span<const std::string_view> variants;
    bool hasThreads; ///< true: the measurement uses BenchSettings::threads
    bool hasGpu;     ///< true: the measurement uses BenchSettings::gpu
    bool hasGl;      ///< true: the measurement uses BenchSettings::gl
    uint64_t usualCount;
    uint64_t mostCount;
    std::string_view elements; ///< name of the counted elements in error messages
    /// Measures one variant.
    /// @param settings options; their member `count` is 1 to mostCount
    /// @return Interrupted after a signal
    base::Result<BenchRow> (*measure)(const BenchSettings& settings, std::string_view variant);
};

/// Creates the subcommand that measures `entry`, which must have static storage.
BenchMeasurement measurementOf(const BenchEntry& entry);

/// Measures the requested variants of an entry.
/// @return one row per variant; InvalidArgument for more than entry.mostCount elements, or the first error of
///         a variant, such as Interrupted
base::Result<std::vector<BenchRow>> measureVariants(const BenchEntry& entry, const BenchSettings& settings);

nlohmann::json toJson(const BenchRow& row);
std::string toText(const BenchRow& row);

} // namespace fx::cli
