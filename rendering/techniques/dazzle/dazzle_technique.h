/// @file dazzle_technique.h
/// Dazzle: glare of light above the saturation of a sensor.
#pragma once

#include "rendering/techniques/draw_technique.h"

namespace fx::render {

extern const DrawTechnique kDazzleTechnique;

} // namespace fx::render
