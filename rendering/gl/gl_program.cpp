#include "rendering/gl/gl_program.h"

#include "rendering/gl/gl_device.h"

#include <algorithm>

namespace fx::render {

namespace {

const char* stageName(GLenum stage)
{
    switch (stage) {
    case GL_VERTEX_SHADER:
        return "vertex";
    case GL_FRAGMENT_SHADER:
        return "fragment";
    default:
        return "compute";
    }
}

template <class GetParameter, class GetLog>
std::string readLog(uint32_t name, const GetParameter& getParameter, const GetLog& getLog)
{
    GLint length = 0;
    getParameter(name, GL_INFO_LOG_LENGTH, &length);
    if (length <= 1)
        return "(the driver gives no reason)";
    std::string log(static_cast<size_t>(length), '\0');
    GLsizei written = 0;
    getLog(name, length, &written, log.data());
    log.resize(static_cast<size_t>(written));
    return log;
}

} // namespace

GlProgramBuild::GlProgramBuild(GlDevice& device, const char* name, std::span<const GlStageSource> stages)
    : device_(&device), name_(name), program_(device, device.gl.CreateProgram())
{
    GlFunctions& gl = device.gl;
    for (size_t i = 0; i < std::min(stages.size(), kMaxStages); ++i) {
        const GlStageSource& source = stages[i];
        const uint32_t shader = gl.CreateShader(source.stage);
        shaders_[i] = {source.stage, source.name, shader};
        const char* text = source.text.c_str();
        const auto length = static_cast<GLint>(source.text.size());
        gl.ShaderSource(shader, 1, &text, &length);
        gl.CompileShader(shader);
        gl.AttachShader(program_.name(), shader);
    }
    gl.LinkProgram(program_.name());
}

GlProgramBuild::~GlProgramBuild()
{
    if (program_.name() == 0)
        return; // finished or moved
    for (const Shader& shader : shaders_)
        if (shader.object)
            device_->gl.DeleteShader(shader.object); // attached shaders exist until the program is deleted
}

/// What the driver says of the first stage that does not compile, or of linking.
std::string GlProgramBuild::reason() const
{
    GlFunctions& gl = device_->gl;
    const std::string program = "program '" + std::string(name_) + "'";
    for (const Shader& shader : shaders_) {
        GLint isCompiled = GL_TRUE;
        if (shader.object)
            gl.GetShaderiv(shader.object, GL_COMPILE_STATUS, &isCompiled);
        if (!isCompiled)
            return program + ": the " + stageName(shader.stage) + " stage '" + shader.name +
                   "' does not compile: " + readLog(shader.object, gl.GetShaderiv, gl.GetShaderInfoLog);
    }
    return program + " does not link: " + readLog(program_.name(), gl.GetProgramiv, gl.GetProgramInfoLog);
}

base::Result<GlProgram> GlProgramBuild::finish()
{
    GlFunctions& gl = device_->gl;
    GLint isLinked = GL_FALSE;
    gl.GetProgramiv(program_.name(), GL_LINK_STATUS, &isLinked);
    if (!isLinked)
        return base::Status(base::Code::GlFailed, reason());
    for (const Shader& shader : shaders_) {
        if (!shader.object)
            continue;
        gl.DetachShader(program_.name(), shader.object);
        gl.DeleteShader(shader.object);
    }
    gl.ObjectLabel(GL_PROGRAM, program_.name(), -1, name_);
    return std::move(program_);
}

GlProgram::~GlProgram()
{
    if (name_)
        device_->gl.DeleteProgram(name_);
}

GlProgram& GlProgram::operator=(GlProgram&& other) noexcept
{
    std::swap(device_, other.device_);
    std::swap(name_, other.name_);
    return *this;
}

} // namespace fx::render
