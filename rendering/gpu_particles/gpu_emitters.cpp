#include "rendering/gpu_particles/gpu_emitters.h"

#include "foundation/random/philox.h"
#include "rendering/gpu_particles/gpu_order_pass.h"

#include <algorithm>
#include <cstdio>

namespace fx::render {

namespace {

using base::RandomPurpose;
static_assert(uint32_t(RandomPurpose::Position) == 1 && uint32_t(RandomPurpose::Direction) == 2 &&
                  uint32_t(RandomPurpose::Life) == 3 && uint32_t(RandomPurpose::Attributes) == 4 &&
                  uint32_t(RandomPurpose::Spin) == 7 && uint32_t(RandomPurpose::Axis) == 8,
              "passes/gpu_particles.comp.glsl has these numbers");
static_assert(base::kTicksPerSecond == 705'600'000, "shared/gpu_particle_words.glsl has its reciprocal");

constexpr ProgramDesc kRows{"gpu particles", nullptr, nullptr, "passes/gpu_particles.comp.glsl", nullptr};
constexpr uint64_t kFramesKept = 300;

bool has(base::ColumnSet columns, size_t column)
{
    return (columns >> column & 1) != 0;
}

/// [byte] that the columns of all rows take.
uint64_t bytesOf(const base::GpuParticleProgram& emitter)
{
    uint64_t row = 0;
    for (size_t c = 0; c < base::particle_column::Count; ++c)
        row += has(emitter.features.columns, c) ? base::columnElementSize(base::kParticleColumns[c].type) : 0;
    return row * emitter.rows;
}

const ProgramDesc& rowsProgram(GlDevice& device, const base::GpuParticleFeatures& f)
{
    namespace column = base::particle_column;
    char defines[256];
    std::snprintf(
        defines, sizeof defines,
        "FX_SHAPE=%u FX_TURNED=%d FX_FRAMES=%u FX_BRIEF=%d FX_LIFE_VARIES=%d FX_DRAGS=%d FX_BY_SPEED=%d "
        "FX_VELOCITY=%d FX_ANGLE=%d FX_FRAME=%d FX_ORIENTATION=%d",
        unsigned(f.shape), f.turned, unsigned(f.frames), f.brief, f.lifeVaries, f.drags, f.bySpeed,
        has(f.columns, column::VelocityX), has(f.columns, column::Angle), has(f.columns, column::Frame),
        has(f.columns, column::OrientationX));
    return device.generated(kRows, defines);
}

} // namespace

base::Status GpuEmitters::compile(const base::GpuParticleFeatures& features)
{
    for (size_t i = 0; i < kGpuOrderPrograms; ++i)
        if (base::Status status = device_.compile(gpuOrderProgram(i)); !status)
            return status;
    return device_.compile(rowsProgram(device_, features));
}

base::Result<const GpuEmitters::Entry*>
GpuEmitters::find(const std::shared_ptr<const base::GpuParticleProgram>& emitter)
{
    for (Entry& entry : entries_)
        if (entry.emitter == emitter) {
            entry.usedFrame = frame_;
            return static_cast<const Entry*>(&entry);
        }
    GLint most = 0;
    device_.gl.GetIntegerv(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &most);
    if (bytesOf(*emitter) > uint64_t(std::max(most, 0)))
        return base::Status(base::Code::TooLarge,
                            "an emitter has more particles than a storage buffer holds");
    if (base::Status status = compile(emitter->features); !status)
        return status;
    auto numbers = GlBuffer::create(device_, sizeof(base::GpuParticleNumbers), "gpu particle numbers");
    if (!numbers)
        return numbers.status();
    device_.gl.NamedBufferSubData(numbers->name(), 0, sizeof(base::GpuParticleNumbers), &emitter->numbers);
    entries_.push_back({emitter, &rowsProgram(device_, emitter->features), std::move(*numbers), frame_});
    return static_cast<const Entry*>(&entries_.back());
}

void GpuEmitters::nextFrame()
{
    ++frame_;
    std::erase_if(entries_, [this](const Entry& entry) { return frame_ - entry.usedFrame >= kFramesKept; });
}

} // namespace fx::render
