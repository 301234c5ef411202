/// @file ribbon_technique.h
/// Trails of particles.
#pragma once

#include "rendering/techniques/draw_technique.h"

namespace fx::render {

extern const DrawTechnique kRibbonTechnique;

} // namespace fx::render
