#include "rendering/gl/gl_program.h"

#include "rendering/gl/gl_device.h"

#include <array>
#include <vector>

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

/// A shader object of one stage, deleted with the scope.
class Shader
{
public:
    Shader(GlFunctions& gl, GLenum stage) : gl_(gl), name_(gl.CreateShader(stage)) {}
    ~Shader() { gl_.DeleteShader(name_); }
    Shader(const Shader&) = delete;
    Shader& operator=(const Shader&) = delete;

    base::Status compile(const char* program, const GlStageSource& source)
    {
        const char* text = source.text.c_str();
        const auto length = static_cast<GLint>(source.text.size());
        gl_.ShaderSource(name_, 1, &text, &length);
        gl_.CompileShader(name_);
        GLint compiled = GL_FALSE;
        gl_.GetShaderiv(name_, GL_COMPILE_STATUS, &compiled);
        if (compiled)
            return {};
        return {base::Code::GlFailed,
                "program '" + std::string(program) + "': the " + stageName(source.stage) + " stage '" +
                    source.name +
                    "' does not compile: " + readLog(name_, gl_.GetShaderiv, gl_.GetShaderInfoLog)};
    }

    uint32_t name() const { return name_; }

private:
    GlFunctions& gl_;
    uint32_t name_;
};

} // namespace

base::Result<GlProgram> GlProgram::link(GlDevice& device, const char* name,
                                        std::span<const GlStageSource> stages)
{
    GlFunctions& gl = device.gl;
    GlProgram program(device, gl.CreateProgram());
    std::vector<uint32_t> attached;
    for (const GlStageSource& stage : stages) {
        Shader shader(gl, stage.stage);
        if (base::Status status = shader.compile(name, stage); !status)
            return status;
        gl.AttachShader(program.name(), shader.name()); // the deleted shader exists until it is detached
        attached.push_back(shader.name());
    }
    gl.LinkProgram(program.name());
    for (const uint32_t shader : attached)
        gl.DetachShader(program.name(), shader);
    GLint linked = GL_FALSE;
    gl.GetProgramiv(program.name(), GL_LINK_STATUS, &linked);
    if (!linked) {
        return base::Status(base::Code::GlFailed,
                            "program '" + std::string(name) + "' does not link: " +
                                readLog(program.name(), gl.GetProgramiv, gl.GetProgramInfoLog));
    }
    gl.ObjectLabel(GL_PROGRAM, program.name(), -1, name);
    return program;
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
