/// @file host_copies.h
/// Copies of host targets that shaders cannot read where they are: windows, renderbuffers, images of several
/// samples, and parts of images. Several samples become one: OpenGL averages colors and picks one depth.
///
/// Threads: [GL thread]. Use: begin(), then color() and depth() while the frame's passes are declared, then
/// copy() before they are executed.
#pragma once

#include "rendering/gl/gl_name.h"
#include "rendering/gl/gl_texture.h"
#include "rendering/host_targets/host_target_check.h"

namespace fx::render {

class HostCopies
{
public:
    explicit HostCopies(GlDevice& device) : device_(device) {}

    /// Begins a frame. `targets` must stay valid until copy().
    void begin(const HostTargets& targets, const HostTargetFacts& facts);

    /// Requests a copy of the picture: of the color texture if there is one, otherwise of the framebuffer.
    /// @return GL name of a texture of the frame's size that receives the copy; 0 on failure, see status()
    uint32_t color();
    /// Requests a copy of the depth. @return as color(), or 0 if the host has no depth that has to be copied
    uint32_t depth();

    /// Failure of color() or depth() since begin(): OutOfMemory.
    const base::Status& status() const { return status_; }

    /// Makes the requested copies. Changes GL_FRAMEBUFFER_SRGB; other states that it changes are restored.
    /// @return GlFailed if OpenGL refuses to copy
    base::Status copy();

    void release();         ///< deletes the textures
    uint64_t bytes() const; ///< [byte] size of the textures

private:
    bool prepare(GlTexture& texture, GLenum format, const char* label);
    void copyColor();
    void copyDepth();
    void blit(uint32_t from, uint32_t to, GLbitfield what);

    GlDevice& device_;
    const HostTargets* targets_ = nullptr;
    HostTargetFacts facts_;
    base::Status status_;
    GlTexture color_, depth_;
    GlFramebuffer source_, destination_;
    bool wantsColor_ = false;
    bool wantsDepth_ = false;
};

} // namespace fx::render
