#include "rendering/gl/gl_messages.h"

namespace fx::render {

GlMessages::GlMessages(GlDevice& device) : device_(device)
{
    device.gl.Enable(GL_DEBUG_OUTPUT);
    device.gl.Enable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
    device.gl.DebugMessageCallback(&GlMessages::receive, this);
}

GlMessages::~GlMessages()
{
    device_.gl.DebugMessageCallback(nullptr, nullptr);
}

void GlMessages::receive(GLenum, GLenum type, GLuint, GLenum severity, GLsizei length, const GLchar* message,
                         const void* user)
{
    auto& self =
        *static_cast<GlMessages*>(const_cast<void*>(user)); // GL hands back the pointer that we gave it
    const bool isError = type == GL_DEBUG_TYPE_ERROR;
    const bool isHigh = severity == GL_DEBUG_SEVERITY_HIGH;
    self.errors_ += isError;
    self.highSeverity_ += isHigh;
    if (!isError && !isHigh)
        return;
    if (self.serious_++ == 0)
        self.first_.assign(message, static_cast<size_t>(length));
}

} // namespace fx::render
