/// @file gl_program.h
/// A linked program. GlDevice::compile() and GlDevice::program() create and cache programs.
#pragma once

#include "foundation/result/status.h"

#include <GL/glcorearb.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>

namespace fx::render {

class GlDevice;

/// Source text of one stage of a program.
struct GlStageSource
{
    GLenum stage;     ///< GL_VERTEX_SHADER, GL_FRAGMENT_SHADER, GL_COMPUTE_SHADER
    const char* name; ///< name for messages
    std::string text; ///< complete text in GLSL
};

class GlProgram
{
public:
    GlProgram() = default;
    GlProgram(GlDevice& device, uint32_t name) : device_(&device), name_(name) {} ///< takes the GL object
    ~GlProgram();
    GlProgram(GlProgram&& other) noexcept : device_(other.device_), name_(std::exchange(other.name_, 0)) {}
    GlProgram& operator=(GlProgram&& other) noexcept;

    uint32_t name() const { return name_; }

private:
    GlDevice* device_ = nullptr;
    uint32_t name_ = 0;
};

/// A program that is being compiled and linked. Drivers that compile in threads of their own do so between
/// the constructor and finish(): start all programs before the first finish().
class GlProgramBuild
{
public:
    /// Starts to compile and link. `name` and the names of the stages must have static storage.
    GlProgramBuild(GlDevice& device, const char* name, std::span<const GlStageSource> stages);
    ~GlProgramBuild();
    GlProgramBuild(GlProgramBuild&&) noexcept = default;
    GlProgramBuild& operator=(GlProgramBuild&&) = delete;

    /// Waits for the driver. May be called once.
    /// @return GlFailed with the program's name, the stage and the driver's log
    base::Result<GlProgram> finish();

private:
    static constexpr size_t kMaxStages = 3;

    struct Shader
    {
        GLenum stage = 0;
        const char* name = nullptr;
        uint32_t object = 0;
    };
    std::string reason() const;

    GlDevice* device_;
    const char* name_;
    GlProgram program_;
    std::array<Shader, kMaxStages> shaders_{}; ///< objects are 0 behind the last stage
};

} // namespace fx::render
