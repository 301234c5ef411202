/// @file gpu_program.h
/// Selects the emitters that the GPU can compute, and creates their GPU parameters.
#pragma once

#include "foundation/snapshot/gpu_particles.h"
#include "simulation/particles/emitter_settings.h"
#include "simulation/particles/particle_program.h"

#include <memory>
#include <string_view>

namespace fx::sim {

/// Reason why an emitter must be computed on the CPU, as text; empty if the GPU can compute it.
std::string_view gpuObstacle(const EmitterSettings& def);

/// Creates the GPU program of an emitter.
/// @param def a definition that the GPU can compute; it is copied
std::shared_ptr<const base::GpuParticleProgram> makeGpuProgram(const EmitterSettings& def);

/// Birth shape of an emitter for the GPU. The shape of `def` must be one of GpuShape.
base::GpuShape gpuShapeOf(const EmitterSettings& def);

/// Parameters of an emitter's births and appearance for the GPU. @param program program of `def`
base::GpuParticleNumbers gpuNumbersOf(const EmitterSettings& def, const ParticleProgram& program);

} // namespace fx::sim
