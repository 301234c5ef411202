/// @file gpu_program.h
/// Which emitters the GPU can compute, and what it has to know of them.
#pragma once

#include "foundation/snapshot/gpu_particles.h"
#include "simulation/particles/emitter_settings.h"

#include <memory>
#include <string_view>

namespace fx::sim {

/// Why an emitter is computed on the CPU, for people; empty when the GPU can do it and is asked to.
std::string_view gpuObstacle(const EmitterSettings& def);

/// @param def one without an obstacle; it is copied
std::shared_ptr<const base::GpuParticleProgram> makeGpuProgram(const EmitterSettings& def);

} // namespace fx::sim
