/// @file light_clouds.h
/// Balls of medium in the light of the sun: how much light leaves them on all sides, by OpenGL and by paths.
#pragma once

#include "benchmarks/accuracy/accuracy_technique.h"

#include <memory>

namespace fx::cli {

/// Settings are optical diameters and substances. Errors are those of the mean light of a picture from the
/// sun's side, from the side and from behind, relative to that of the path tracer; `work` has the means.
/// @param isSmall a few substances in small pictures
std::unique_ptr<AccuracyTechnique> makeLightClouds(bool isSmall);

} // namespace fx::cli
