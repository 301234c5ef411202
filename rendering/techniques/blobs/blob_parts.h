/// @file blob_parts.h
/// Parts of the description of spherical billboards: their light and their scalability levels.
#pragma once

#include "rendering/lights/effect_lights.h"
#include "rendering/techniques/quality_knob.h"

namespace fx::render {

/// Light of glowing media: formula light-of-media.
extern const LightSource kBlobLights;

extern const ScalabilitySettings kBlobScalability;

} // namespace fx::render
