/// @file gpu_numbers.h
/// What the GPU has to know of an emitter's births and looks.
#pragma once

#include "foundation/snapshot/gpu_particles.h"
#include "simulation/emitters/emitter_def.h"
#include "simulation/particles/particle_program.h"

namespace fx::sim {

/// @param def its shape is one that GpuShape has
base::GpuShape gpuShapeOf(const EmitterDef& def);

/// The same. @param program of `def`
base::GpuParticleNumbers gpuNumbersOf(const EmitterDef& def, const ParticleProgram& program);

} // namespace fx::sim
