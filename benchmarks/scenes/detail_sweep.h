/// @file detail_sweep.h
/// Extinction of an effect with detail relative to the extinction without detail, during the life of the
/// effect.
#pragma once

#include "benchmarks/scenes/detail_scene.h"

namespace fx::cli {

/// Ratio of the extinction with and without detail, over all balls of the effect.
struct ExtinctionSweep
{
    std::vector<double> times;  ///< [s]
    std::vector<double> ratios; ///< [1]
};

/// Measures the ratio at `count` times from DetailSubject::first to last, by parallel rays.
/// @param side number of rays along a side of the square that covers all balls
base::Result<ExtinctionSweep> sweepExtinction(const DetailSubject& subject, int count, int side,
                                              const std::function<bool()>& stop);

/// [1] Conservation factors (see conservation_factor.h) of the effect's largest group with detail, in frames
/// at 60 Hz from DetailSubject::time on.
base::Result<std::vector<double>> factorsOfFrames(const DetailSubject& subject, int frames,
                                                  const std::function<bool()>& stop);

} // namespace fx::cli
