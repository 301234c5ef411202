#include "rendering/gl/gl_device.h"

#include "shaders/shader_library.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <utility>
#include <vector>

namespace fx::render {

namespace {

constexpr int kRequiredVersion = 45;

std::string text(const GLubyte* string)
{
    return string ? reinterpret_cast<const char*>(string) : "unknown";
}

std::string versionNumber(int version)
{
    return std::to_string(version / 10) + "." + std::to_string(version % 10);
}

base::Status lostStatus()
{
    return {base::Code::GlLost,
            "the OpenGL context is lost, with all textures, buffers and programs: create a "
            "new one and call fxContext_RestoreGl"};
}

} // namespace

base::Result<std::unique_ptr<GlDevice>> GlDevice::create(const GlLoader& loader,
                                                         std::pmr::memory_resource* memory)
{
    std::unique_ptr<GlDevice> device(new GlDevice(memory));
    const base::Status loaded = device->gl.load(loader);
    if (!device->gl.GetIntegerv.isLoaded() || !device->gl.GetString.isLoaded())
        return loaded;
    // An old context misses functions too, but its version is the better explanation.
    if (base::Status status = device->readLimits(); !status)
        return status;
    if (!loaded)
        return loaded;
    return device;
}

/// Mesa holds on to the program that was used after a compute program, also when it is deleted, until another
/// compute program is used.
GlDevice::~GlDevice()
{
    const auto computes = [](const auto& entry) { return entry.first->compute != nullptr; };
    const auto compute = std::find_if(programs_.begin(), programs_.end(), computes);
    if (compute == programs_.end())
        return;
    GLint host = 0, isDeleted = GL_FALSE;
    gl.GetIntegerv(GL_CURRENT_PROGRAM, &host);
    if (host != 0)
        gl.GetProgramiv(static_cast<GLuint>(host), GL_DELETE_STATUS, &isDeleted);
    if (isDeleted != GL_FALSE)
        return; // it lasts only as long as it is used
    gl.UseProgram(compute->second.name());
    gl.UseProgram(static_cast<GLuint>(host));
}

base::Status GlDevice::readLimits()
{
    const auto integer = [this](GLenum what) {
        GLint value = 0;
        gl.GetIntegerv(what, &value);
        return value;
    };
    limits_.version = 10 * integer(GL_MAJOR_VERSION) + integer(GL_MINOR_VERSION);
    limits_.renderer = text(gl.GetString(GL_RENDERER));
    limits_.versionText = text(gl.GetString(GL_VERSION));
    if (limits_.version == 0)
        return {base::Code::GlUnsupported, "no OpenGL context is current on this thread"};
    if (limits_.version < kRequiredVersion) {
        return {base::Code::GlUnsupported, "OpenGL " + versionNumber(kRequiredVersion) +
                                               " is required, the current context is " +
                                               versionNumber(limits_.version) + " (" + limits_.renderer +
                                               ", " + limits_.versionText + ")"};
    }
    limits_.textureSize = integer(GL_MAX_TEXTURE_SIZE);
    limits_.volumeSize = integer(GL_MAX_3D_TEXTURE_SIZE);
    limits_.uniformAlignment = integer(GL_UNIFORM_BUFFER_OFFSET_ALIGNMENT);
    limits_.uniformBlockBytes = integer(GL_MAX_UNIFORM_BLOCK_SIZE);
    limits_.storageAlignment = integer(GL_SHADER_STORAGE_BUFFER_OFFSET_ALIGNMENT);
    limits_.reportsReset = integer(GL_RESET_NOTIFICATION_STRATEGY) == GL_LOSE_CONTEXT_ON_RESET;
    limits_.tellsTextureTarget = (integer(GL_CONTEXT_PROFILE_MASK) & GL_CONTEXT_CORE_PROFILE_BIT) != 0;
    limits_.debugContext = (integer(GL_CONTEXT_FLAGS) & GL_CONTEXT_FLAG_DEBUG_BIT) != 0;
    return {};
}

base::Result<std::string> GlDevice::source(const char* name, const char* defines) const
{
    const std::string_view definitions = defines ? defines : "";
    if (sourceOverride_) {
        if (std::optional<std::string> replaced = sourceOverride_(name, definitions))
            return std::move(*replaced);
    }
    if (std::optional<std::string> embedded = shaders::assemble(name, definitions))
        return std::move(*embedded);
    return base::Status(base::Code::NotFound,
                        "shader '" + std::string(name) + "' or one of its includes is not embedded");
}

base::Result<GlProgramBuild> GlDevice::start(const ProgramDesc& desc)
{
    const std::array<std::pair<GLenum, const char*>, 3> files{{{GL_VERTEX_SHADER, desc.vertex},
                                                               {GL_FRAGMENT_SHADER, desc.fragment},
                                                               {GL_COMPUTE_SHADER, desc.compute}}};
    std::array<GlStageSource, 3> stages;
    size_t count = 0;
    for (const auto& [stage, file] : files) {
        if (!file)
            continue;
        base::Result<std::string> text = source(file, desc.defines);
        if (!text)
            return text.status();
        stages[count++] = {stage, file, std::move(*text)};
    }
    return GlProgramBuild(*this, desc.name, std::span(stages).first(count));
}

base::Status GlDevice::compile(std::span<const ProgramDesc* const> descs)
{
    std::pmr::vector<std::pair<const ProgramDesc*, GlProgramBuild>> builds(memory_);
    base::Status status;
    for (const ProgramDesc* desc : descs) {
        const auto isSame = [desc](const auto& build) { return build.first == desc; };
        if (programs_.contains(desc) || std::ranges::any_of(builds, isSame))
            continue;
        base::Result<GlProgramBuild> build = start(*desc);
        if (!build) {
            status = build.status();
            break;
        }
        builds.emplace_back(desc, std::move(*build));
    }
    for (auto& [desc, build] : builds) {
        base::Result<GlProgram> program = build.finish();
        if (!program)
            return program.status();
        programs_.insert_or_assign(desc, std::move(*program));
        ++programsCompiled_;
    }
    return status;
}

base::Status GlDevice::compile(const ProgramDesc& desc)
{
    const ProgramDesc* const one = &desc;
    return compile(std::span(&one, 1));
}

const ProgramDesc& GlDevice::generated(const ProgramDesc& like, std::string_view defines)
{
    for (const auto& known : generated_)
        if (known->like == &like && known->defines == defines)
            return known->desc;
    generated_.push_back(std::make_unique<Generated>(Generated{&like, std::string(defines), like}));
    Generated& made = *generated_.back();
    made.desc.defines = made.defines.c_str();
    return made.desc;
}

uint32_t GlDevice::program(const ProgramDesc& desc, base::Status& outStatus)
{
    if (const auto found = programs_.find(&desc); found != programs_.end())
        return found->second.name();
    ++lateCompiles_;
    if (base::Status status = compile(desc); !status) {
        outStatus = std::move(status);
        return 0;
    }
    return programs_.find(&desc)->second.name();
}

base::Status GlDevice::takeError(std::string_view where)
{
    constexpr int kMaxPending = 16; // a context of a defective driver may report errors for ever
    const GLenum first = gl.GetError();
    GLenum next = first;
    for (int i = 0; i < kMaxPending && next != GL_NO_ERROR && next != GL_CONTEXT_LOST; ++i)
        next = gl.GetError();
    if (next == GL_CONTEXT_LOST)
        reportLoss();
    if (isLost())
        return lostStatus();
    if (first == GL_NO_ERROR)
        return {};
    char number[16];
    std::snprintf(number, sizeof number, "0x%04X", first);
    const bool outOfMemory = first == GL_OUT_OF_MEMORY;
    return {outOfMemory ? base::Code::OutOfMemory : base::Code::GlFailed,
            std::string(where) + ": OpenGL error " + number + (outOfMemory ? " (out of memory)" : "")};
}

base::Status GlDevice::pollLoss()
{
    if (!isLost() && limits_.reportsReset && gl.GetGraphicsResetStatus() != GL_NO_ERROR)
        reportLoss();
    return isLost() ? lostStatus() : base::Status();
}

base::Status GlDevice::orLost(base::Status status)
{
    if (!status)
        (void)takeError("finding a reason"); // an error that is left belongs to the call that has failed
    return isLost() ? lostStatus() : status;
}

} // namespace fx::render
