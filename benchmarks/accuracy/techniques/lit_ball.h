/// @file lit_ball.h
/// A homogeneous ball in parallel light: distribution of the light that leaves the ball.
#pragma once

#include "benchmarks/accuracy/accuracy_technique.h"

#include <memory>

namespace fx::cli {

/// Each setting is a substance with an optical diameter. The errors are the standard errors of two fractions
/// of the light. One fraction leaves through the half facing the sun, the other fraction through the opposite
/// half. AccuracySample::work contains both fractions.
std::unique_ptr<AccuracyTechnique> makeLitBallAccuracy();

} // namespace fx::cli
