/// @file gpu_numbers.h
/// Parameters of an emitter's births and appearance for the GPU.
#pragma once

#include "foundation/snapshot/gpu_particles.h"
#include "simulation/particles/emitter_settings.h"
#include "simulation/particles/particle_program.h"

namespace fx::sim {

/// @param def its shape is one that GpuShape has
base::GpuShape gpuShapeOf(const EmitterSettings& def);

/// The same. @param program of `def`
base::GpuParticleNumbers gpuNumbersOf(const EmitterSettings& def, const ParticleProgram& program);

} // namespace fx::sim
