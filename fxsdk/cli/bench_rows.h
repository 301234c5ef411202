/// @file bench_rows.h
/// The measurements behind the entries of fx bench.
#pragma once

#include "fxsdk/cli/bench_entry.h"

namespace fx::cli {

base::Result<std::vector<BenchRow>> benchParticles(const BenchSettings& settings);
base::Result<std::vector<BenchRow>> benchManySmall(const BenchSettings& settings);
base::Result<std::vector<BenchRow>> benchSort(const BenchSettings& settings);
base::Result<std::vector<BenchRow>> benchEmit(const BenchSettings& settings);
base::Result<std::vector<BenchRow>> benchFrame(const BenchSettings& settings);

} // namespace fx::cli
