#include "rendering/gpu_particles/gpu_states.h"

#include "rendering/gl/gl_device.h"

#include <algorithm>
#include <bit>
#include <cstring>

namespace fx::render {

namespace {

constexpr uint64_t kFramesKept = 120;
constexpr uint64_t kReachedWords = 7; ///< of a row, as in gpu_particles/gpu_particle_steps.glsl
constexpr uint32_t kHeadWords = 4;    ///< likewise

} // namespace

base::Result<GpuStates::State*> GpuStates::find(const base::SnapshotGroup& group)
{
    const base::GroupInfo& info = group.info();
    for (State& state : states_)
        if (state.instance == info.instance && state.solver == info.solver &&
            state.emitter == group.program())
            return &state;
    const uint64_t bytes = kReachedWords * 4 * group.program()->rows;
    GLint most = 0;
    device_.gl.GetIntegerv(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &most);
    if (bytes > uint64_t(std::max(most, 0)))
        return base::Status(base::Code::TooLarge,
                            "an emitter has more particles than a storage buffer holds");
    auto reached = GlBuffer::create(device_, size_t(bytes), "gpu particle states");
    if (!reached)
        return reached.status();
    states_.push_back({info.instance, info.solver, group.program(), std::move(*reached), {}, 0, {}, 0});
    return &states_.back();
}

base::Status GpuStates::prepare(const base::SnapshotGroup& group, GpuRowsJob& ioJob)
{
    if (!group.program()->features.steps)
        return {};
    const auto found = find(group);
    if (!found)
        return found.status();
    State& state = **found;
    state.usedFrame = frame_;
    const base::GpuParticleMoment moment = base::gpuMomentOf(group);
    const bool goesOn = base::continuesFrom(group, state.mark);
    const int64_t since = goesOn ? moment.now - state.mark.now : 0; // [tick] ago
    words_.assign(kHeadWords, 0);
    std::memcpy(words_.data(), &since, sizeof since);
    words_[2] = goesOn ? 1 : 0;
    group.program()->writeSteps(group, goesOn ? state.mark.now : INT64_MIN / 4, words_);
    ioJob.stepCount = uint32_t((words_.size() - kHeadWords) / group.program()->features.stepWords);
    GlBuffer& steps = state.steps[state.turn++ % 2];
    const size_t bytes = words_.size() * 4;
    if (steps.bytes() < bytes) {
        auto made = GlBuffer::create(device_, std::bit_ceil(bytes), "gpu particle steps");
        if (!made)
            return made.status();
        steps = std::move(*made);
    }
    device_.gl.NamedBufferSubData(steps.name(), 0, GLsizeiptr(bytes), words_.data());
    ioJob.reached = {state.reached.name(), {}, 0, state.reached.bytes()};
    ioJob.steps = {steps.name(), {}, 0, steps.bytes()};
    state.mark = base::gpuMarkOf(group);
    return {};
}

void GpuStates::nextFrame()
{
    ++frame_;
    std::erase_if(states_, [this](const State& state) { return frame_ - state.usedFrame > kFramesKept; });
}

void GpuStates::forget()
{
    for (State& state : states_)
        state.mark = {};
}

uint64_t GpuStates::bytes() const
{
    uint64_t sum = 0;
    for (const State& state : states_)
        sum += state.reached.bytes() + state.steps[0].bytes() + state.steps[1].bytes();
    return sum;
}

} // namespace fx::render
