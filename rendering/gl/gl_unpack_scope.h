/// @file gl_unpack_scope.h
/// Uploads of texels from client memory, whatever the host has set for its own. Threads: [GL thread].
#pragma once

#include "rendering/gl/gl_functions.h"

#include <array>

namespace fx::render {

/// Tightly packed rows from client memory while it lives; the host's settings afterwards.
class GlUnpackScope
{
public:
    explicit GlUnpackScope(const GlFunctions& gl) : gl_(gl)
    {
        gl.GetIntegerv(GL_PIXEL_UNPACK_BUFFER_BINDING, &buffer_);
        gl.BindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
        for (size_t i = 0; i < kParameters.size(); ++i) {
            gl.GetIntegerv(kParameters[i], &saved_[i]);
            gl.PixelStorei(kParameters[i], kParameters[i] == GL_UNPACK_ALIGNMENT ? 1 : 0);
        }
    }
    ~GlUnpackScope()
    {
        for (size_t i = 0; i < kParameters.size(); ++i)
            gl_.PixelStorei(kParameters[i], saved_[i]);
        gl_.BindBuffer(GL_PIXEL_UNPACK_BUFFER, static_cast<GLuint>(buffer_));
    }
    GlUnpackScope(const GlUnpackScope&) = delete;
    GlUnpackScope& operator=(const GlUnpackScope&) = delete;

private:
    static constexpr std::array<GLenum, 8> kParameters = {
        GL_UNPACK_SWAP_BYTES,  GL_UNPACK_LSB_FIRST, GL_UNPACK_ROW_LENGTH,  GL_UNPACK_IMAGE_HEIGHT,
        GL_UNPACK_SKIP_PIXELS, GL_UNPACK_SKIP_ROWS, GL_UNPACK_SKIP_IMAGES, GL_UNPACK_ALIGNMENT};

    const GlFunctions& gl_;
    GLint buffer_ = 0;
    std::array<GLint, kParameters.size()> saved_{};
};

} // namespace fx::render
