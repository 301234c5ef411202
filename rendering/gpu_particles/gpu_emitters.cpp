#include "rendering/gpu_particles/gpu_emitters.h"

#include "foundation/random/philox.h"
#include "rendering/gpu_particles/gpu_depth.h"
#include "rendering/gpu_particles/gpu_order_pass.h"

#include <algorithm>
#include <cstdio>
#include <string>

namespace fx::render {

namespace {

using base::RandomPurpose;
static_assert(uint32_t(RandomPurpose::Position) == 1 && uint32_t(RandomPurpose::Direction) == 2 &&
                  uint32_t(RandomPurpose::Life) == 3 && uint32_t(RandomPurpose::Attributes) == 4 &&
                  uint32_t(RandomPurpose::Spin) == 7 && uint32_t(RandomPurpose::Axis) == 8,
              "gpu_particles/gpu_particles.comp.glsl has these numbers");
static_assert(base::kTicksPerSecond == 705'600'000,
              "gpu_particles/gpu_particle_words.glsl has its reciprocal");

constexpr ProgramDesc kRows{"gpu particles", nullptr, nullptr, "gpu_particles/gpu_particles.comp.glsl",
                            nullptr};
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

using base::GpuModule;
static_assert(uint32_t(GpuModule::Plane) == 16 && uint32_t(GpuModule::Box) == 19 &&
                  uint32_t(GpuModule::Depth) == 20,
              "gpu_particles/gpu_particle_contacts.glsl has these numbers");

/// What calls the modules before those that are met: functions of gpu_particles/gpu_particle_forces.glsl.
constexpr const char* kFunctions[] = {
    "addGravity",       "addLift",          "addCurl",       "addGust",    "addQuadraticDrag", "addVortex",
    "addHoldingVortex", "addSpring",        "addConstant",   "addInverse", "addInverseSquare", "addFieldAir",
    "addFieldForce",    "addConformSphere", "addConformBox", "meetBounce"};
static_assert(std::size(kFunctions) == size_t(base::kFirstGpuObstacle));

void addCall(std::string& io, const char* function, uint32_t first, uint32_t second)
{
    io.append(function).append("(").append(std::to_string(first)).append(",");
    io.append(std::to_string(second)).append(");");
}

/// The definitions that put a program together from its modules.
void addModules(const base::GpuParticleFeatures& features, uint32_t stepWords, std::string& io)
{
    std::string forces, contacts, near, meet, push, inside;
    for (const base::GpuModuleUse& use : features.modules) {
        const auto module = uint32_t(use.module);
        if (use.module < base::kFirstGpuObstacle) {
            addCall(use.module < base::kFirstGpuContact ? forces : contacts, kFunctions[module], use.numbers,
                    use.word);
            continue;
        }
        if (use.module == GpuModule::Depth) { // it tells of ways, not of places
            near.append("askNearDepth(").append(std::to_string(use.numbers)).append(");");
            meet.append("meetDepth(").append(std::to_string(use.numbers)).append(");");
            continue;
        }
        addCall(near, "askNear", module, use.numbers);
        addCall(meet, "meet", module, use.numbers);
        addCall(push, "push", module, use.numbers);
        addCall(inside, "askInside", module, use.numbers);
    }
    if (!meet.empty()) {
        contacts += "followPath();";
        io.append(" FX_NEAR=").append(near).append(" FX_MEET=").append(meet);
        io.append(" FX_PUSH=").append(push).append(" FX_INSIDE=").append(inside);
    }
    io.append(meetsDepth(features) ? " FX_DEPTH=1" : " FX_DEPTH=0");
    io.append(" FX_STEPS=1 FX_STEP_WORDS=").append(std::to_string(stepWords));
    io.append(" FX_FORCES=").append(forces).append(" FX_CONTACTS=").append(contacts);
}

const ProgramDesc& rowsProgram(GlDevice& device, const base::GpuParticleFeatures& f)
{
    namespace column = base::particle_column;
    char defines[320];
    std::snprintf(
        defines, sizeof defines,
        "FX_SHAPE=%u FX_TURNED=%d FX_FRAMES=%u FX_BRIEF=%d FX_LIFE_VARIES=%d FX_DRAGS=%d FX_BY_SPEED=%d "
        "FX_VELOCITY=%d FX_ANGLE=%d FX_FRAME=%d FX_ORIENTATION=%d FX_WIDE=%d FX_LIFE_TABLE=%d "
        "FX_SPEED_TABLE=%d",
        unsigned(f.shape), f.turned, unsigned(f.frames), f.brief, f.lifeVaries, f.drags, f.bySpeed,
        has(f.columns, column::VelocityX), has(f.columns, column::Angle), has(f.columns, column::Frame),
        has(f.columns, column::OrientationX), f.wide, f.lifeTable, f.speedTable);
    if (!f.steps)
        return device.generated(kRows, std::string(defines) + " FX_STEPS=0 FX_DEPTH=0");
    std::string all(defines);
    addModules(f, f.stepWords, all);
    return device.generated(kRows, all);
}

} // namespace

base::Status GpuEmitters::compile(const base::GpuParticleProgram& emitter)
{
    const size_t orders = emitter.rows >= kRadixOrderRows ? kGpuOrderPrograms : kFirstRadixProgram;
    for (size_t i = 0; i < orders; ++i)
        if (base::Status status = device_.compile(gpuOrderProgram(i)); !status)
            return status;
    return device_.compile(rowsProgram(device_, emitter.features));
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
    const size_t more = std::max<size_t>(emitter->moduleNumbers.size(), 1) * sizeof(float);
    const uint64_t largest = std::max<uint64_t>(bytesOf(*emitter), sizeof(base::GpuParticleNumbers) + more);
    if (largest > uint64_t(std::max(most, 0)))
        return base::Status(base::Code::TooLarge,
                            "an emitter has more particles or numbers than a storage buffer holds");
    if (base::Status status = compile(*emitter); !status)
        return status;
    auto numbers = GlBuffer::create(device_, sizeof(base::GpuParticleNumbers) + more, "gpu particle numbers");
    if (!numbers)
        return numbers.status();
    device_.gl.NamedBufferSubData(numbers->name(), 0, sizeof(base::GpuParticleNumbers), &emitter->numbers);
    if (!emitter->moduleNumbers.empty())
        device_.gl.NamedBufferSubData(numbers->name(), sizeof(base::GpuParticleNumbers), GLsizeiptr(more),
                                      emitter->moduleNumbers.data());
    entries_.push_back({emitter, &rowsProgram(device_, emitter->features), std::move(*numbers), frame_});
    return static_cast<const Entry*>(&entries_.back());
}

uint64_t GpuEmitters::bytes() const
{
    uint64_t sum = 0;
    for (const Entry& entry : entries_)
        sum += entry.numbers.bytes();
    return sum;
}

void GpuEmitters::nextFrame()
{
    ++frame_;
    std::erase_if(entries_, [this](const Entry& entry) { return frame_ - entry.usedFrame >= kFramesKept; });
}

} // namespace fx::render
