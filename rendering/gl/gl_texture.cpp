#include "rendering/gl/gl_texture.h"

#include "rendering/gl/gl_device.h"

#include <string>

namespace fx::render {

namespace {

uint64_t texelBytes(GLenum internalFormat)
{
    switch (internalFormat) {
    case GL_RGBA32F:
        return 16;
    case GL_RGB32F:
        return 12;
    case GL_RGBA16F:
    case GL_RG32F:
    case GL_DEPTH32F_STENCIL8:
        return 8;
    case GL_R16F:
        return 2;
    case GL_R8:
        return 1;
    default:
        return 4;
    }
}

} // namespace

GLenum glInternalFormat(Format format)
{
    switch (format) {
    case Format::RGBA32F:
        return GL_RGBA32F;
    case Format::RGBA16F:
        return GL_RGBA16F;
    case Format::RGBA8:
        return GL_RGBA8;
    case Format::RG32F:
        return GL_RG32F;
    case Format::R32F:
        return GL_R32F;
    case Format::R32UI:
        return GL_R32UI;
    case Format::Depth32F:
        return GL_DEPTH_COMPONENT32F;
    }
    return GL_NONE;
}

base::Result<GlTexture> GlTexture::create(GlDevice& device, int width, int height, GLenum internalFormat,
                                          const char* label)
{
    const int largest = device.limits().textureSize;
    const std::string what = "texture '" + std::string(label) + "' of " + std::to_string(width) + "x" +
                             std::to_string(height) + " pixels";
    if (width < 1 || height < 1 || width > largest || height > largest)
        return base::Status(base::Code::InvalidArgument,
                            what + ": sides must be from 1 to " + std::to_string(largest));

    GlFunctions& gl = device.gl;
    (void)device.takeError(label); // what is pending is not ours
    GlTexture texture;
    texture.device_ = &device;
    gl.CreateTextures(GL_TEXTURE_2D, 1, &texture.name_);
    gl.TextureStorage2D(texture.name_, 1, internalFormat, width, height);
    if (base::Status status = device.takeError(what); !status)
        return status;
    gl.TextureParameteri(texture.name_, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    gl.TextureParameteri(texture.name_, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    gl.TextureParameteri(texture.name_, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    gl.TextureParameteri(texture.name_, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    gl.ObjectLabel(GL_TEXTURE, texture.name_, -1, label);
    texture.width_ = width;
    texture.height_ = height;
    texture.internalFormat_ = internalFormat;
    device.countTextureBytes(static_cast<int64_t>(texture.bytes()));
    return texture;
}

GlTexture::~GlTexture()
{
    if (!name_)
        return;
    device_->countTextureBytes(-static_cast<int64_t>(bytes()));
    device_->gl.DeleteTextures(1, &name_);
}

GlTexture& GlTexture::operator=(GlTexture&& other) noexcept
{
    std::swap(device_, other.device_);
    std::swap(name_, other.name_);
    std::swap(width_, other.width_);
    std::swap(height_, other.height_);
    std::swap(internalFormat_, other.internalFormat_);
    return *this;
}

uint64_t GlTexture::bytes() const
{
    return static_cast<uint64_t>(width_) * static_cast<uint64_t>(height_) * texelBytes(internalFormat_);
}

} // namespace fx::render
