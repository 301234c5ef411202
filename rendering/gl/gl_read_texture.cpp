#include "rendering/gl/gl_read_texture.h"

#include "rendering/gl/gl_device.h"

#include <array>

namespace fx::render {

namespace {

/// Tightly packed rows into client memory while it lives; the host's settings afterwards.
class PackScope
{
public:
    explicit PackScope(GlFunctions& gl) : gl_(gl)
    {
        gl.GetIntegerv(GL_PIXEL_PACK_BUFFER_BINDING, &buffer_);
        gl.BindBuffer(GL_PIXEL_PACK_BUFFER, 0);
        for (size_t i = 0; i < kParameters.size(); ++i) {
            gl.GetIntegerv(kParameters[i], &saved_[i]);
            gl.PixelStorei(kParameters[i], kParameters[i] == GL_PACK_ALIGNMENT ? 1 : 0);
        }
    }
    ~PackScope()
    {
        for (size_t i = 0; i < kParameters.size(); ++i)
            gl_.PixelStorei(kParameters[i], saved_[i]);
        gl_.BindBuffer(GL_PIXEL_PACK_BUFFER, static_cast<GLuint>(buffer_));
    }
    PackScope(const PackScope&) = delete;
    PackScope& operator=(const PackScope&) = delete;

private:
    static constexpr std::array<GLenum, 8> kParameters = {
        GL_PACK_SWAP_BYTES,  GL_PACK_LSB_FIRST, GL_PACK_ROW_LENGTH,  GL_PACK_IMAGE_HEIGHT,
        GL_PACK_SKIP_PIXELS, GL_PACK_SKIP_ROWS, GL_PACK_SKIP_IMAGES, GL_PACK_ALIGNMENT};

    GlFunctions& gl_;
    GLint buffer_ = 0;
    std::array<GLint, kParameters.size()> saved_{};
};

template <class T>
std::vector<T> read(GlDevice& device, uint32_t texture, int width, int height, int channels, GLenum format,
                    GLenum type)
{
    std::vector<T> texels(static_cast<size_t>(width) * static_cast<size_t>(height) *
                          static_cast<size_t>(channels));
    const PackScope pack(device.gl);
    device.gl.GetTextureImage(texture, 0, format, type, static_cast<GLsizei>(texels.size() * sizeof(T)),
                              texels.data());
    return texels;
}

GLenum pixelFormat(int channels)
{
    constexpr std::array<GLenum, 4> kFormats = {GL_RED, GL_RG, GL_RGB, GL_RGBA};
    return kFormats[static_cast<size_t>(channels - 1)];
}

} // namespace

std::vector<float> readTexture(GlDevice& device, uint32_t texture, int width, int height, int channels)
{
    return read<float>(device, texture, width, height, channels, pixelFormat(channels), GL_FLOAT);
}

std::vector<float> readDepthTexture(GlDevice& device, uint32_t texture, int width, int height)
{
    return read<float>(device, texture, width, height, 1, GL_DEPTH_COMPONENT, GL_FLOAT);
}

std::vector<uint32_t> readUintTexture(GlDevice& device, uint32_t texture, int width, int height, int channels)
{
    return read<uint32_t>(device, texture, width, height, channels,
                          channels == 2 ? GL_RG_INTEGER : GL_RED_INTEGER, GL_UNSIGNED_INT);
}

std::vector<float> readFramebuffer(GlDevice& device, uint32_t framebuffer, int width, int height,
                                   int channels)
{
    std::vector<float> texels(static_cast<size_t>(width) * static_cast<size_t>(height) *
                              static_cast<size_t>(channels));
    GLint before = 0;
    device.gl.GetIntegerv(GL_READ_FRAMEBUFFER_BINDING, &before);
    device.gl.BindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer);
    {
        const PackScope pack(device.gl);
        device.gl.ReadPixels(0, 0, width, height, pixelFormat(channels), GL_FLOAT, texels.data());
    }
    device.gl.BindFramebuffer(GL_READ_FRAMEBUFFER, static_cast<GLuint>(before));
    return texels;
}

} // namespace fx::render
