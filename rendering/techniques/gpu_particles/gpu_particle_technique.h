/// @file gpu_particle_technique.h
/// Particles that are simulated on the GPU.
#pragma once

#include "rendering/techniques/draw_technique.h"

namespace fx::render {

extern const DrawTechnique kGpuParticleTechnique;

} // namespace fx::render
