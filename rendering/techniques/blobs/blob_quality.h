/// @file blob_quality.h
/// What quality may lower of media.
#pragma once

#include "rendering/techniques/quality_knob.h"

namespace fx::render {

extern const ScalabilitySettings kBlobScalability;

} // namespace fx::render
