/// @file bench_rows.h
/// The measurements behind the entries of fx bench.
#pragma once

#include "fxsdk/cli/bench_entry.h"
#include "fxsdk/cli/bench_stage.h"

namespace fx::cli {

/// Plays and times `steps` frames of a stage whose instances all show `effect`.
/// @param row receives everything but name, variant and count, which measureVariants() sets
/// @return Interrupted after a signal
base::Status timeStage(BenchStage& stage, uint32_t steps, const sim::EffectDef& effect, BenchRow& row);

/// One variant of the entry particles, computed on the GPU where it can; else as without.
base::Result<BenchRow> measureOnGpu(const BenchSettings& settings, std::string_view variant);

base::Result<BenchRow> benchParticles(const BenchSettings& settings, std::string_view variant);
base::Result<BenchRow> benchManySmall(const BenchSettings& settings, std::string_view variant);
/// The same with a view that draws.
base::Result<BenchRow> benchManyDrawn(const BenchSettings& settings, std::string_view variant);
base::Result<BenchRow> benchSort(const BenchSettings& settings, std::string_view variant);
base::Result<BenchRow> benchEmit(const BenchSettings& settings, std::string_view variant);
base::Result<BenchRow> benchFrame(const BenchSettings& settings, std::string_view variant);

} // namespace fx::cli
