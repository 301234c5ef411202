/// @file bench_rows.h
/// The measurements behind the entries of fx bench.
#pragma once

#include "fxsdk/cli/bench_entry.h"
#include "fxsdk/cli/bench_stage.h"

namespace fx::cli {

/// Plays and times `steps` frames of a stage whose instances all show `effect`.
/// @param row has name, variant and count; gets everything else
/// @return Interrupted after a signal
base::Status timeStage(BenchStage& stage, uint32_t steps, const sim::EffectDef& effect, BenchRow& row);

/// One variant of the entry particles, computed on the GPU where it can; else as without.
base::Result<BenchRow> measureOnGpu(const BenchSettings& settings, std::string_view variant);

base::Result<std::vector<BenchRow>> benchParticles(const BenchSettings& settings);
base::Result<std::vector<BenchRow>> benchManySmall(const BenchSettings& settings);
base::Result<std::vector<BenchRow>> benchSort(const BenchSettings& settings);
base::Result<std::vector<BenchRow>> benchEmit(const BenchSettings& settings);
base::Result<std::vector<BenchRow>> benchFrame(const BenchSettings& settings);

} // namespace fx::cli
