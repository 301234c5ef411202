/// @file dazzle_technique.h
/// Dazzle: the glare of what is brighter than a sensor can take.
#pragma once

#include "rendering/techniques/draw_technique.h"

namespace fx::render {

extern const DrawTechnique kDazzleTechnique;

} // namespace fx::render
