/// @file light_clouds.h
/// Accuracy of the light that balls of medium in sunlight scatter to all sides: OpenGL compared with path
/// tracing.
#pragma once

#include "benchmarks/accuracy/accuracy_technique.h"

#include <memory>

namespace fx::cli {

/// Each setting is a substance with an optical diameter. The errors are errors of the mean light of pictures,
/// relative to the path tracer. The pictures are taken from the sun's side, from the side and from behind.
/// AccuracySample::work contains the mean light.
/// @param isSmall true: a few substances in small pictures
std::unique_ptr<AccuracyTechnique> makeLightClouds(bool isSmall);

} // namespace fx::cli
