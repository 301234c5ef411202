/// @file lit_ball.h
/// A homogeneous ball in parallel light: where the light leaves it.
#pragma once

#include "benchmarks/accuracy/accuracy_technique.h"

#include <memory>

namespace fx::cli {

/// Settings are optical diameters and substances. The errors are the standard errors of the shares of the
/// light that leave through the sunward and through the far half of the surface; `work` has the shares.
std::unique_ptr<AccuracyTechnique> makeLitBallAccuracy();

} // namespace fx::cli
