/// @file particle_light_technique.h
/// Lights that particles shed, from snapshot data of the kind "light". They are not drawn themselves.
#pragma once

#include "rendering/techniques/draw_technique.h"

namespace fx::render {

extern const DrawTechnique kParticleLightTechnique;

} // namespace fx::render
