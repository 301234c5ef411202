/// @file gl_program.h
/// A linked program. GlDevice::compile() and GlDevice::program() create and cache programs.
#pragma once

#include "foundation/result/status.h"

#include <GL/glcorearb.h>

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
    /// Compiles the stages and links the program.
    /// @return GlFailed with the program's name, the stage and the driver's log
    static base::Result<GlProgram> link(GlDevice& device, const char* name,
                                        std::span<const GlStageSource> stages);

    GlProgram() = default;
    ~GlProgram();
    GlProgram(GlProgram&& other) noexcept : device_(other.device_), name_(std::exchange(other.name_, 0)) {}
    GlProgram& operator=(GlProgram&& other) noexcept;

    uint32_t name() const { return name_; }

private:
    GlProgram(GlDevice& device, uint32_t name) : device_(&device), name_(name) {}

    GlDevice* device_ = nullptr;
    uint32_t name_ = 0;
};

} // namespace fx::render
