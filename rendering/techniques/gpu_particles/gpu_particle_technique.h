/// @file gpu_particle_technique.h
/// Particles that the GPU computes where it draws them.
#pragma once

#include "rendering/techniques/draw_technique.h"

namespace fx::render {

extern const DrawTechnique kGpuParticleTechnique;

} // namespace fx::render
