/// @file light_slice_technique.h
/// Shadows of media as a technique: timer group and scalability levels of light slices. The passes are in
/// rendering/lights/slices; every view has them.
#pragma once

#include "rendering/techniques/draw_technique.h"

namespace fx::render {

extern const DrawTechnique kLightSliceTechnique;

} // namespace fx::render
