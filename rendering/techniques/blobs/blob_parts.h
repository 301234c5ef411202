/// @file blob_parts.h
/// Parts of the description of the blob technique: its lights and its scalability levels.
#pragma once

#include "rendering/lights/effect_lights.h"
#include "rendering/techniques/quality_knob.h"

namespace fx::render {

/// The lights of glowing media, computed by formula light-of-media.
extern const LightSource kBlobLights;

extern const ScalabilitySettings kBlobScalability;

} // namespace fx::render
