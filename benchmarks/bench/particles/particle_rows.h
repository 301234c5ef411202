/// @file particle_rows.h
/// Common code of the measurements of particles.
#pragma once

#include "benchmarks/bench/bench_row.h"
#include "benchmarks/bench/particles/bench_stage.h"

namespace fx::cli {

/// Plays and times `steps` frames of a stage, all instances of which show `effect`.
/// @param row receives everything except name, variant and count, which measureVariants() sets
/// @return Interrupted after a signal
base::Status timeStage(BenchStage& stage, uint32_t steps, const sim::EffectDef& effect, BenchRow& row);

/// Measures one variant of fx bench particles on the CPU.
base::Result<BenchRow> benchParticles(const BenchSettings& settings, std::string_view variant);
std::span<const std::string_view> particleVariants();

/// Measures one variant of fx bench particles on the GPU if possible.
base::Result<BenchRow> measureOnGpu(const BenchSettings& settings, std::string_view variant);

/// Number of particles of one effect of a variant of fx bench many-small.
inline uint32_t manySmallParticles(std::string_view variant)
{
    return variant == "many" ? 10 : 1000;
}

/// Measures fx bench many-small with a view that draws.
base::Result<BenchRow> benchManyDrawn(const BenchSettings& settings, std::string_view variant);

} // namespace fx::cli
