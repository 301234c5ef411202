/// @file gpu_states.h
/// State of stepped particles on the GPU, in one view.
///
/// The state of an emitter continues from step to step. If it belongs to another history (the host has gone
/// back in time) or does not exist (the view is new, or the emitter was hidden for long), its particles take
/// all steps since their births again, with the same bits.
///
/// Threads: [GL thread].
#pragma once

#include "foundation/snapshot/gpu_particles.h"
#include "rendering/gl/gl_buffer.h"
#include "rendering/gpu_particles/gpu_rows_pass.h"

#include <array>
#include <cstdint>
#include <memory>
#include <memory_resource>
#include <vector>

namespace fx::render {

class GlDevice;

class GpuStates
{
public:
    GpuStates(GlDevice& device, std::pmr::memory_resource* memory) : device_(device), states_(memory) {}

    /// Completes a job, and assumes that it will run after the earlier ones. Does nothing if the group's
    /// motion has a closed form. At most two jobs of an emitter in a frame.
    /// @return OutOfMemory, TooLarge (for the context's storage buffers)
    base::Status prepare(const base::SnapshotGroup& group, GpuRowsJob& ioJob);
    /// Drops states that have not been used for a long time.
    void nextFrame();
    /// Jobs have not run: all begins anew.
    void forget();

    uint64_t bytes() const; ///< [byte] held

private:
    struct State
    {
        uint64_t instance;
        uint32_t solver;
        std::shared_ptr<const base::GpuParticleProgram> emitter;
        GlBuffer reached;
        std::array<GlBuffer, 2> steps; ///< by turns: two jobs of a frame need their own
        uint32_t turn = 0;
        base::GpuStepMark mark;
        uint64_t usedFrame = 0;
    };
    base::Result<State*> find(const base::SnapshotGroup& group);

    GlDevice& device_;
    std::pmr::vector<State> states_;
    std::vector<uint32_t> words_; ///< room
    uint64_t frame_ = 0;
};

} // namespace fx::render
