/// @file gpu_program.h
/// Selection of emitters for the GPU, and their parameters there.
#pragma once

#include "foundation/snapshot/gpu_particles.h"
#include "simulation/particles/emitter_settings.h"

#include <memory>
#include <string_view>

namespace fx::sim {

/// Reason why an emitter is computed on the CPU, as text; empty for the GPU.
std::string_view gpuObstacle(const EmitterSettings& def);

/// @param def one without an obstacle; it is copied
std::shared_ptr<const base::GpuParticleProgram> makeGpuProgram(const EmitterSettings& def);

} // namespace fx::sim
