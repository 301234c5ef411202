/// @file gpu_states.h
/// GPU state of particles whose motion is computed in steps, for one view.
///
/// A step continues from the emitter's state after the previous step. The previous state cannot be used if
/// the host has gone back in time. The state does not exist if the view is new, or if the emitter was hidden
/// for a long time. In all three cases, all steps since the births of the particles are computed again. The
/// result is bit-identical.
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

    /// Sets `reached`, `steps` and `stepCount` of a job. Jobs must run in the order in which they were
    /// prepared. The function does nothing if the group's motion has a closed form. An emitter may have at
    /// most two jobs per frame.
    /// @return OutOfMemory, TooLarge (for the context's storage buffers)
    base::Status prepare(const base::SnapshotGroup& group, GpuRowsJob& ioJob);
    /// Deletes states that have not been used for a long time.
    void nextFrame();
    /// Must be called if prepared jobs have not run. Then all states are computed again from the births of
    /// the particles.
    void forget();

    uint64_t bytes() const; ///< [byte] size of all buffers

private:
    struct State
    {
        uint64_t instance;
        uint32_t solver;
        std::shared_ptr<const base::GpuParticleProgram> emitter;
        GlBuffer reached;
        /// Data of steps, one buffer for each of the two jobs of a frame.
        std::array<GlBuffer, 2> steps;
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
