/// @file gpu_program.h
/// Selection of emitters for the GPU, and their parameters there.
#pragma once

#include "foundation/snapshot/gpu_particles.h"
#include "simulation/particles/emitter_settings.h"
#include "simulation/particles/particle_program.h"

#include <memory>
#include <string_view>

namespace fx::sim {

/// Reason why an emitter is computed on the CPU, as text; empty for the GPU.
std::string_view gpuObstacle(const EmitterSettings& def);

/// @param def one without an obstacle; it is copied
std::shared_ptr<const base::GpuParticleProgram> makeGpuProgram(const EmitterSettings& def);

/// Birth shape of an emitter for the GPU. @param def its shape is one that GpuShape has
base::GpuShape gpuShapeOf(const EmitterSettings& def);

/// Parameters of an emitter's births and appearance for the GPU. @param program of `def`
base::GpuParticleNumbers gpuNumbersOf(const EmitterSettings& def, const ParticleProgram& program);

} // namespace fx::sim
