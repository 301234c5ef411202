/// @file gl_texture.h
/// A texture of two or three dimensions with immutable storage, without mipmaps.
#pragma once

#include "foundation/result/status.h"
#include "rendering/frame_graph/backend.h"

#include <GL/glcorearb.h>

#include <cstdint>
#include <string>
#include <utility>

namespace fx::render {

class GlDevice;

GLenum glInternalFormat(Format format); ///< returns the GL format, such as GL_RGBA32F

class GlTexture
{
public:
    /// Creates a texture of two dimensions.
    /// @param label a string literal, shown in debuggers and error messages
    /// @return InvalidArgument if a side is not in [1, limits().textureSize], OutOfMemory
    static base::Result<GlTexture> create(GlDevice& device, int width, int height, GLenum internalFormat,
                                          const char* label);

    /// Creates a texture of three dimensions.
    /// @return InvalidArgument if a side is not in [1, limits().volumeSize], OutOfMemory
    static base::Result<GlTexture> createVolume(GlDevice& device, int width, int height, int depth,
                                                GLenum internalFormat, const char* label);

    GlTexture() = default;
    ~GlTexture();
    GlTexture(GlTexture&& other) noexcept { *this = std::move(other); }
    GlTexture& operator=(GlTexture&& other) noexcept;

    uint32_t name() const { return name_; }
    int width() const { return width_; }   ///< [pixel]
    int height() const { return height_; } ///< [pixel]
    int depth() const { return depth_; }   ///< [pixel] 1 for a texture of two dimensions
    GLenum internalFormat() const { return internalFormat_; }
    uint64_t bytes() const; ///< [byte] size of all texels; 0 without a texture

private:
    base::Status finish(GlDevice& device, const std::string& what, const char* label);

    GlDevice* device_ = nullptr;
    uint32_t name_ = 0;
    int width_ = 0;
    int height_ = 0;
    int depth_ = 1;
    GLenum internalFormat_ = 0;
};

} // namespace fx::render
