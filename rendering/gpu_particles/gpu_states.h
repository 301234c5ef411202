/// @file gpu_states.h
/// State on the GPU of particles whose motion is computed in steps, for one view.
///
/// Each step continues from the state of an emitter after the last step. The state may belong to another
/// history, if the host has gone back in time. Or it does not exist, because the view is new or the emitter
/// was hidden for long. In both cases all steps since the births of the particles are computed again, with
/// the same bits.
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

    /// Sets the members of a job that concern steps. The job must run after jobs that were prepared earlier.
    /// Does nothing if the group's motion has a closed form. An emitter may have at most two jobs per frame.
    /// @return OutOfMemory, TooLarge (for the context's storage buffers)
    base::Status prepare(const base::SnapshotGroup& group, GpuRowsJob& ioJob);
    /// Deletes states that have not been used for a long time.
    void nextFrame();
    /// Call this if prepared jobs have not run: all states are computed from the births again.
    void forget();

    uint64_t bytes() const; ///< [byte] held

private:
    struct State
    {
        uint64_t instance;
        uint32_t solver;
        std::shared_ptr<const base::GpuParticleProgram> emitter;
        GlBuffer reached;
        std::array<GlBuffer, 2> steps; ///< used alternately: each of two jobs of a frame needs its own
        uint32_t turn = 0;
        base::GpuStepMark mark;
        uint64_t usedFrame = 0;
    };
    base::Result<State*> find(const base::SnapshotGroup& group);

    GlDevice& device_;
    std::pmr::vector<State> states_;
    std::vector<uint32_t> words_; ///< scratch
    uint64_t frame_ = 0;
};

} // namespace fx::render
