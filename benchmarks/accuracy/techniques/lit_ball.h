/// @file lit_ball.h
/// A homogeneous ball in parallel light: distribution of the light that leaves it.
#pragma once

#include "benchmarks/accuracy/accuracy_technique.h"

#include <memory>

namespace fx::cli {

/// Each setting is a substance with an optical diameter. The errors are the standard errors of the shares of
/// light that leave through the half facing the sun and through the opposite half. AccuracySample::work
/// contains the shares.
std::unique_ptr<AccuracyTechnique> makeLitBallAccuracy();

} // namespace fx::cli
