/// @file light_clouds.h
/// Balls of medium in sunlight: light that leaves them to all sides, by OpenGL and by path tracing.
#pragma once

#include "benchmarks/accuracy/accuracy_technique.h"

#include <memory>

namespace fx::cli {

/// Settings are optical diameters and substances. Errors are those of the mean light of pictures from the
/// sun's side, from the side and from behind, relative to the path tracer; `work` contains the means.
/// @param isSmall true: a few substances in small pictures
std::unique_ptr<AccuracyTechnique> makeLightClouds(bool isSmall);

} // namespace fx::cli
