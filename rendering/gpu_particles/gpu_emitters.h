/// @file gpu_emitters.h
/// GPU data of emitters whose particles the GPU computes: a program for each combination of features, and a
/// buffer with constants for each emitter.
///
/// Programs and buffers are created when an emitter first needs them. Threads: [GL thread].
#pragma once

#include "foundation/snapshot/gpu_particles.h"
#include "rendering/gl/gl_buffer.h"
#include "rendering/gl/gl_device.h"

#include <cstdint>
#include <memory>
#include <memory_resource>
#include <vector>

namespace fx::render {

class GpuEmitters
{
public:
    GpuEmitters(GlDevice& device, std::pmr::memory_resource* memory) : device_(device), entries_(memory) {}

    struct Entry
    {
        std::shared_ptr<const base::GpuParticleProgram> emitter;
        const ProgramDesc* program;
        GlBuffer numbers;
        uint64_t usedFrame;
    };

    /// Compiles the compute and sorting programs for the features of `emitter`, unless they are compiled
    /// already.
    /// @return GlFailed (compilation failed), GlUnsupported (built without FXSDK_GPU_PARTICLES)
    base::Status compile(const base::GpuParticleProgram& emitter);
    /// Returns the GPU data of an emitter, valid until the next call. The first call for an emitter compiles
    /// programs and uploads constants.
    /// @return the errors of compile(), OutOfMemory, TooLarge (the constants exceed the limit of storage
    ///         buffers)
    base::Result<const Entry*> find(const std::shared_ptr<const base::GpuParticleProgram>& emitter);
    /// Removes emitters that have not been used for a long time.
    void nextFrame();

    uint64_t bytes() const; ///< [byte] size of all buffers

private:
    GlDevice& device_;
    std::pmr::vector<Entry> entries_;
    uint64_t frame_ = 0;
};

} // namespace fx::render
