/// @file blob_quality.h
/// Scalability levels of media.
#pragma once

#include "rendering/techniques/quality_knob.h"

namespace fx::render {

extern const ScalabilitySettings kBlobScalability;

} // namespace fx::render
