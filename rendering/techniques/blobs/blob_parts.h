/// @file blob_parts.h
/// Parts of the description of spherical billboards: their light and their scalability levels.
#pragma once

#include "rendering/lights/effect_lights.h"
#include "rendering/techniques/quality_knob.h"

namespace fx::render {

/// A blob of cross section s and source B sends B s (1 - exp(-t)) / t candela in every direction, t = 3.5 s /
/// (pi R^2) being its optical depth: thin gas shows all of its medium, thick gas only its face. Attenuation
/// by the rest of the group is estimated by the same factor with the group's mean optical depth.
extern const LightSource kBlobLights;

extern const ScalabilitySettings kBlobScalability;

} // namespace fx::render
