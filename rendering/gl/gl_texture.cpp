#include "rendering/gl/gl_texture.h"

#include "rendering/gl/gl_device.h"

#include <algorithm>
#include <string>

namespace fx::render {

namespace {

uint64_t texelBytes(GLenum internalFormat)
{
    switch (internalFormat) {
    case GL_RGBA32F:
    case GL_RGBA32UI:
        return 16;
    case GL_RGB32F:
        return 12;
    case GL_RGBA16F:
    case GL_RG32F:
    case GL_RG32UI:
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
    case Format::RG32UI:
        return GL_RG32UI;
    case Format::RGBA32UI:
        return GL_RGBA32UI;
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

    (void)device.takeError(label); // what is pending is not ours
    GlTexture texture;
    texture.width_ = width;
    texture.height_ = height;
    texture.internalFormat_ = internalFormat;
    device.gl.CreateTextures(GL_TEXTURE_2D, 1, &texture.name_);
    device.gl.TextureStorage2D(texture.name_, 1, internalFormat, width, height);
    if (base::Status status = texture.finish(device, what, label); !status)
        return status;
    return texture;
}

base::Result<GlTexture> GlTexture::createVolume(GlDevice& device, int width, int height, int depth,
                                                GLenum internalFormat, const char* label)
{
    const int largest = device.limits().volumeSize;
    const std::string what = "texture '" + std::string(label) + "' of " + std::to_string(width) + "x" +
                             std::to_string(height) + "x" + std::to_string(depth) + " texels";
    if (std::min({width, height, depth}) < 1 || std::max({width, height, depth}) > largest)
        return base::Status(base::Code::InvalidArgument,
                            what + ": sides must be from 1 to " + std::to_string(largest));
    (void)device.takeError(label); // what is pending is not ours
    GlTexture texture;
    texture.width_ = width;
    texture.height_ = height;
    texture.depth_ = depth;
    texture.internalFormat_ = internalFormat;
    device.gl.CreateTextures(GL_TEXTURE_3D, 1, &texture.name_);
    device.gl.TextureStorage3D(texture.name_, 1, internalFormat, width, height, depth);
    if (base::Status status = texture.finish(device, what, label); !status)
        return status;
    return texture;
}

/// What all of them share, once they have storage.
base::Status GlTexture::finish(GlDevice& device, const std::string& what, const char* label)
{
    GlFunctions& gl = device.gl;
    base::Status status = device.takeError(what);
    device_ = &device;
    if (name_ != 0) // the destructor takes back what has a name
        device.countTextureBytes(static_cast<int64_t>(bytes()));
    if (!status)
        return status;
    gl.TextureParameteri(name_, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    gl.TextureParameteri(name_, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    for (const GLenum wrap : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T, GL_TEXTURE_WRAP_R})
        gl.TextureParameteri(name_, wrap, GL_CLAMP_TO_EDGE);
    gl.ObjectLabel(GL_TEXTURE, name_, -1, label);
    return {};
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
    std::swap(depth_, other.depth_);
    std::swap(internalFormat_, other.internalFormat_);
    return *this;
}

uint64_t GlTexture::bytes() const
{
    return static_cast<uint64_t>(width_) * static_cast<uint64_t>(height_) * static_cast<uint64_t>(depth_) *
           texelBytes(internalFormat_);
}

} // namespace fx::render
