/// @file sprite_technique.h
/// Particles that are drawn as sprites or meshes.
#pragma once

#include "rendering/techniques/draw_technique.h"

namespace fx::render {

extern const DrawTechnique kSpriteTechnique;

} // namespace fx::render
