// Stands for the other sources of this folder in builds without FXSDK_GPU_PARTICLES.
#include "rendering/gpu_particles/gpu_emitters.h"
#include "rendering/gpu_particles/gpu_order_pass.h"
#include "rendering/gpu_particles/gpu_rows_pass.h"
#include "rendering/gpu_particles/gpu_states.h"

namespace fx::render {

base::Status GpuEmitters::compile(const base::GpuParticleProgram&)
{
    return {base::Code::GlUnsupported, "the library was built without FXSDK_GPU_PARTICLES"};
}

base::Result<const GpuEmitters::Entry*>
GpuEmitters::find(const std::shared_ptr<const base::GpuParticleProgram>& emitter)
{
    return compile(*emitter);
}

void GpuEmitters::nextFrame() {}

uint64_t GpuEmitters::bytes() const
{
    return 0;
}

base::Status GpuStates::prepare(const base::SnapshotGroup&, GpuRowsJob&)
{
    return {base::Code::GlUnsupported, "the library was built without FXSDK_GPU_PARTICLES"};
}

void GpuStates::nextFrame() {}

void GpuStates::forget() {}

uint64_t GpuStates::bytes() const
{
    return 0;
}

bool meetsDepth(const base::GpuParticleFeatures&)
{
    return false;
}

void GpuRowsPass::addTo(FrameGraph&, std::span<const GpuRowsJob>, std::span<ParticleBatch>, const GpuDepth&)
{}

void GpuOrderPass::addTo(FrameGraph&, std::span<const GpuOrderJob>, std::span<ParticleBatch>, uint32_t) {}

} // namespace fx::render
