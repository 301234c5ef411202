/// @file detail_sweep.h
/// What detail leaves of the whole extinction of an effect, through its life.
#pragma once

#include "benchmarks/scenes/detail_scene.h"

namespace fx::cli {

/// Extinction with over that without detail, of all balls of the effect.
struct ExtinctionSweep
{
    std::vector<double> times;  ///< [s]
    std::vector<double> ratios; ///< [1]
};

/// At `count` times from DetailSubject::first to last, by parallel rays.
/// @param side [ray] of the square of rays around all balls
base::Result<ExtinctionSweep> sweepExtinction(const DetailSubject& subject, int count, int side,
                                              const std::function<bool()>& stop);

/// [1] the factor of the effect's largest group with detail, see conservation_factor.h, in frames at 60 Hz
/// from DetailSubject::time on.
base::Result<std::vector<double>> factorsOfFrames(const DetailSubject& subject, int frames,
                                                  const std::function<bool()>& stop);

} // namespace fx::cli
