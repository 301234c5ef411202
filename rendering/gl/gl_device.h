/// @file gl_device.h
/// Data about one OpenGL context: its functions, its limits, the programs compiled in it, the bytes held.
///
/// Threads: [GL thread], the thread on which the context is current; also for create() and destruction.
/// Ownership: everything made from a device must be destroyed before it.
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
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace fx::render {

/// Read once when the device is created; frames make no such queries.
struct GlLimits
{
    int version = 0;           ///< 10 major + minor
    int textureSize = 0;       ///< [pixel] largest width and height
    int volumeSize = 0;        ///< [pixel] largest side of a texture of three dimensions
    int uniformAlignment = 0;  ///< [byte] of offsets into uniform buffers
    int uniformBlockBytes = 0; ///< [byte] largest uniform block
    int storageAlignment = 0;  ///< [byte] of offsets into storage buffers
    bool debugContext = false; ///< passes are named by debug groups
    std::string renderer;      ///< as the driver names itself
    std::string versionText;
};

class GlDevice
{
public:
    /// Replaces the embedded GLSL: complete text of `name` under `defines`, or nothing to use the embedded
    /// one.
    using SourceOverride =
        std::function<std::optional<std::string>(std::string_view name, std::string_view defines)>;

    /// @return GlUnsupported naming the functions or the version that are missing, InvalidArgument without a
    /// loader
    static base::Result<std::unique_ptr<GlDevice>> create(const GlLoader& loader,
                                                          std::pmr::memory_resource* memory);
    ~GlDevice();
    GlDevice(const GlDevice&) = delete;
    GlDevice& operator=(const GlDevice&) = delete;

    GlFunctions gl;

    const GlLimits& limits() const { return limits_; }
    std::pmr::memory_resource* memory() const { return memory_; }
    uint64_t callCount() const { return gl.monitor.calls; } ///< GL calls since creation

    /// Compiles the program `desc` in advance unless it is compiled already. `desc` has static storage;
    /// programs are identified by the address of their description.
    /// @return GlFailed with stage, file and the driver's log; NotFound when a source does not exist
    base::Status compile(const ProgramDesc& desc);

    /// A program whose macro definitions are only known at run time: `like` with `defines`. Equal arguments
    /// give the same object during the lifetime of the device.
    const ProgramDesc& generated(const ProgramDesc& like, std::string_view defines);

    /// GL name of the program, which is compiled and counted now if it was not warmed up. 0 when it does not
    /// compile; `outStatus` then has the reason.
    uint32_t program(const ProgramDesc& desc, base::Status& outStatus);

    uint32_t programsCompiled() const { return programsCompiled_; } ///< since creation, late ones included
    uint32_t lateCompiles() const { return lateCompiles_; } ///< compiled by a draw instead of by compile()

    void setSourceOverride(SourceOverride sourceOverride) { sourceOverride_ = std::move(sourceOverride); }
    void forgetPrograms() { programs_.clear(); } ///< the next use compiles again; for live editing

    uint64_t textureBytes() const { return textureBytes_; } ///< [byte] of live GlTextures
    uint64_t bufferBytes() const { return bufferBytes_; }   ///< [byte] of live GlBuffers
    void countTextureBytes(int64_t change) { textureBytes_ += static_cast<uint64_t>(change); }
    void countBufferBytes(int64_t change) { bufferBytes_ += static_cast<uint64_t>(change); }

    /// Discards pending GL errors and names the first one; Ok without errors.
    base::Status takeError(std::string_view where);

private:
    explicit GlDevice(std::pmr::memory_resource* memory) : memory_(memory), programs_(memory) {}
    base::Status readLimits();
    base::Result<std::string> source(const char* name, const char* defines) const;
    base::Result<GlProgram> build(const ProgramDesc& desc);

    std::pmr::memory_resource* memory_;
    GlLimits limits_;
    SourceOverride sourceOverride_;
    std::pmr::unordered_map<const ProgramDesc*, GlProgram> programs_;
    struct Generated
    {
        const ProgramDesc* like;
        std::string defines;
        ProgramDesc desc; ///< its defines are those above
    };
    std::vector<std::unique_ptr<Generated>> generated_;
    uint32_t programsCompiled_ = 0;
    uint32_t lateCompiles_ = 0;
    uint64_t textureBytes_ = 0;
    uint64_t bufferBytes_ = 0;
};

} // namespace fx::render
