/// @file gl_device.h
/// Data about one OpenGL context: functions, limits, compiled programs, allocated bytes.
///
/// Threads: [GL thread], the thread on which the context is current, also for create() and the destructor.
/// Ownership: all objects created with a device must be destroyed before the device.
#pragma once

#include "foundation/result/status.h"
#include "rendering/frame_graph/backend.h"
#include "rendering/gl/gl_functions.h"
#include "rendering/gl/gl_program.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <memory_resource>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace fx::render {

/// Limits of the context, queried when the device is created.
struct GlLimits
{
    int version = 0;           ///< version of OpenGL: 10 * major + minor
    int textureSize = 0;       ///< [pixel] largest width and height
    int volumeSize = 0;        ///< [pixel] largest side of a texture of three dimensions
    int uniformAlignment = 0;  ///< [byte] alignment of offsets into uniform buffers
    int uniformBlockBytes = 0; ///< [byte] largest uniform block
    int storageAlignment = 0;  ///< [byte] alignment of offsets into storage buffers
    bool debugContext = false; ///< true: passes are named by debug groups
    /// True in core profiles. Elsewhere Mesa refuses the query GL_TEXTURE_TARGET, with an error in each call.
    bool tellsTextureTarget = false;
    bool reportsReset = false; ///< true: a reset of the GPU loses the context, and GL reports the reset
    std::string renderer;      ///< GL_RENDERER
    std::string versionText;
};

class GlStateGuard;

class GlDevice
{
public:
    /// A function that replaces embedded GLSL. The function returns the complete text of the source `name`
    /// with `defines`. If it returns no text, the embedded text is used.
    using SourceOverride =
        std::function<std::optional<std::string>(std::string_view name, std::string_view defines)>;

    /// Creates a device for the current context.
    /// @return GlUnsupported with the missing functions or version in the message, InvalidArgument without a
    ///         loader
    static base::Result<std::unique_ptr<GlDevice>> create(const GlLoader& loader,
                                                          std::pmr::memory_resource* memory);
    ~GlDevice();
    GlDevice(const GlDevice&) = delete;
    GlDevice& operator=(const GlDevice&) = delete;

    GlFunctions gl;
    /// Saves states of the host before they are first changed, during a frame; null: no frame, or the host
    /// saves its states.
    GlStateGuard* guard = nullptr;

    const GlLimits& limits() const { return limits_; }
    std::pmr::memory_resource* memory() const { return memory_; }
    uint64_t callCount() const { return gl.monitor.calls; } ///< number of GL calls since creation

    /// Compiles programs in advance, except for those that are compiled already. Drivers that compile in
    /// threads of their own compile all of them at once. Descriptions must have static storage, because
    /// programs are identified by the address of their description.
    /// @return GlFailed with stage, file and the driver's log of the first program that does not compile;
    ///         NotFound if a source does not exist. Programs before it are compiled.
    base::Status compile(std::span<const ProgramDesc* const> descs);
    /// Compiles one program in advance.
    base::Status compile(const ProgramDesc& desc);

    /// Returns a program description with macro definitions that are computed at run time: a copy of `like`
    /// with `defines`. Equal arguments return the same object during the lifetime of the device.
    const ProgramDesc& generated(const ProgramDesc& like, std::string_view defines);

    /// Returns the GL name of the program. If the program is not compiled yet, it is compiled now and
    /// counted in lateCompiles(). If compilation fails, the result is 0, and `outStatus` has the reason.
    uint32_t program(const ProgramDesc& desc, base::Status& outStatus);

    /// Number of programs compiled since creation, including lateCompiles().
    uint32_t programsCompiled() const { return programsCompiled_; }
    /// Number of programs that were compiled by program() and not in advance by compile().
    uint32_t lateCompiles() const { return lateCompiles_; }

    void setSourceOverride(SourceOverride sourceOverride) { sourceOverride_ = std::move(sourceOverride); }
    /// Discards all programs, so that the next use of a program compiles it again. Used for live editing.
    void forgetPrograms() { programs_.clear(); }

    uint64_t textureBytes() const { return textureBytes_; } ///< [byte] size of all existing GlTextures
    uint64_t bufferBytes() const { return bufferBytes_; }   ///< [byte] size of all existing GlBuffers
    void countTextureBytes(int64_t change) { textureBytes_ += static_cast<uint64_t>(change); }
    void countBufferBytes(int64_t change) { bufferBytes_ += static_cast<uint64_t>(change); }

    /// Discards pending GL errors. Returns the first error, or Ok without errors. @param where text for the
    /// message  @return GlLost, OutOfMemory, GlFailed
    base::Status takeError(std::string_view where);

    /// True when the context is lost: no function of `gl` calls OpenGL any more.
    bool isLost() const { return gl.monitor.isLost; }
    /// Marks the context as lost. Objects of this device must be created again with another device.
    void reportLoss() { gl.monitor.isLost = true; }
    /// Asks GL whether the context is lost, if GL reports resets.
    /// @return GlLost if the context is lost
    base::Status pollLoss();
    /// GlLost if the context is lost, otherwise `status`. After a failure GL is asked for its errors, because
    /// a lost context lets all calls fail.
    base::Status orLost(base::Status status);

private:
    explicit GlDevice(std::pmr::memory_resource* memory) : memory_(memory), programs_(memory) {}
    base::Status readLimits();
    base::Result<std::string> source(const char* name, const char* defines) const;
    base::Result<GlProgramBuild> start(const ProgramDesc& desc);

    std::pmr::memory_resource* memory_;
    GlLimits limits_;
    SourceOverride sourceOverride_;
    std::pmr::unordered_map<const ProgramDesc*, GlProgram> programs_;
    struct Generated
    {
        const ProgramDesc* like;
        std::string defines;
        ProgramDesc desc; ///< refers to `defines`
    };
    std::vector<std::unique_ptr<Generated>> generated_;
    uint32_t programsCompiled_ = 0;
    uint32_t lateCompiles_ = 0;
    uint64_t textureBytes_ = 0;
    uint64_t bufferBytes_ = 0;
};

} // namespace fx::render
