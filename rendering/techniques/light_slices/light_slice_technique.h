/// @file light_slice_technique.h
/// Shadows of media as a part of quality: the time of the planes of all lights, and what may be lowered of
/// them. The passes themselves are those of rendering/lights/slices, which every view has.
#pragma once

#include "rendering/techniques/draw_technique.h"

namespace fx::render {

extern const DrawTechnique kLightSliceTechnique;

} // namespace fx::render
