/// @file gl_messages.h
/// Counts the driver's KHR_debug messages, for contexts that were created with debug = true.
#pragma once

#include "rendering/gl/gl_device.h"

#include <cstdint>
#include <string>

namespace fx::render {

/// Receives messages during its lifetime. A message is received during the GL call that causes it.
class GlMessages
{
public:
    explicit GlMessages(GlDevice& device);
    ~GlMessages();
    GlMessages(const GlMessages&) = delete;
    GlMessages& operator=(const GlMessages&) = delete;

    uint32_t errors() const { return errors_; } ///< number of messages of the type error
    /// Number of messages of high severity, of any type.
    uint32_t highSeverity() const { return highSeverity_; }
    /// Number of messages that are errors or have high severity; 0 for a correct program.
    uint32_t serious() const { return serious_; }
    /// Text of the first error or message of high severity.
    const std::string& first() const { return first_; }

private:
    static void APIENTRY receive(GLenum source, GLenum type, GLuint id, GLenum severity, GLsizei length,
                                 const GLchar* message, const void* user);

    GlDevice& device_;
    uint32_t errors_ = 0;
    uint32_t highSeverity_ = 0;
    uint32_t serious_ = 0;
    std::string first_;
};

} // namespace fx::render
