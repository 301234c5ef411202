/// @file explosion.h
/// The scene "explosion" of fx accuracy sph: the library's explosion.
#pragma once

#include "benchmarks/accuracy/accuracy_technique.h"

namespace fx::cli {

std::unique_ptr<AccuracyTechnique> makeExplosionAccuracy(const AccuracyScale& scale);

} // namespace fx::cli
