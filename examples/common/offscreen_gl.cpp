#include "offscreen_gl.h"

#include <epoxy/egl.h>
#include <epoxy/gl.h>
#include <spng.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <stdexcept>

namespace example {

namespace {

/// A display-referred value of 0 to 1 as a byte.
uint8_t byteOf(float value)
{
    return uint8_t(std::lround(255.0f * (value > 0.0f ? std::min(value, 1.0f) : 0.0f))); // NaN is 0
}

/// A display that needs no screen, or the default one.
EGLDisplay openDisplay()
{
    if (const EGLDisplay display =
            eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
        display != EGL_NO_DISPLAY && eglInitialize(display, nullptr, nullptr))
        return display;
    const EGLDisplay display = eglGetDisplay(EGL_DEFAULT_DISPLAY);
    return display != EGL_NO_DISPLAY && eglInitialize(display, nullptr, nullptr) ? display : EGL_NO_DISPLAY;
}

} // namespace

OffscreenGl::OffscreenGl() : display_(openDisplay()), context_(EGL_NO_CONTEXT)
{
    if (display_ == EGL_NO_DISPLAY || !eglBindAPI(EGL_OPENGL_API))
        throw std::runtime_error("no EGL display with OpenGL; install libegl1 and libgl1-mesa-dri");
    const EGLint attributes[] = {EGL_CONTEXT_MAJOR_VERSION,
                                 4,
                                 EGL_CONTEXT_MINOR_VERSION,
                                 5,
                                 EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                 EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                 EGL_NONE};
    context_ = eglCreateContext(display_, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes);
    if (context_ == EGL_NO_CONTEXT || !eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_))
        throw std::runtime_error("EGL has no OpenGL 4.5 core context without a surface");
}

OffscreenGl::~OffscreenGl()
{
    eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    eglDestroyContext(display_, context_);
}

void* findOffscreenFunction(void*, const char* name)
{
    return reinterpret_cast<void*>(eglGetProcAddress(name));
}

Picture::Picture(int width, int height) : width_(width), height_(height)
{
    glCreateTextures(GL_TEXTURE_2D, 2, names_);
    glTextureStorage2D(names_[0], 1, GL_RGBA32F, width, height);
    glTextureStorage2D(names_[1], 1, GL_DEPTH_COMPONENT32F, width, height);
}

Picture::~Picture()
{
    glDeleteTextures(2, names_);
}

void Picture::clear(const float rgba[4])
{
    const float farPlane = 1.0f;
    glClearTexImage(names_[0], 0, GL_RGBA, GL_FLOAT, rgba);
    glClearTexImage(names_[1], 0, GL_DEPTH_COMPONENT, GL_FLOAT, &farPlane);
}

void Picture::writePng(const std::string& path) const
{
    const size_t row = size_t(width_) * 3;
    std::vector<float> values(row * size_t(height_));
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glGetTextureImage(names_[0], 0, GL_RGB, GL_FLOAT, int(values.size() * sizeof(float)), values.data());
    std::vector<uint8_t> bytes(values.size());
    for (size_t y = 0; y < size_t(height_); ++y) // GL's rows begin at the bottom
        std::transform(&values[y * row], &values[y * row] + row, &bytes[(size_t(height_) - 1 - y) * row],
                       byteOf);
    example::writePng(path, width_, height_, bytes);
}

void writePng(const std::string& path, int width, int height, const std::vector<uint8_t>& rgb)
{
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "wb"), std::fclose);
    const std::unique_ptr<spng_ctx, void (*)(spng_ctx*)> png(spng_ctx_new(SPNG_CTX_ENCODER), spng_ctx_free);
    spng_ihdr header{};
    header.width = uint32_t(width);
    header.height = uint32_t(height);
    header.bit_depth = 8;
    header.color_type = SPNG_COLOR_TYPE_TRUECOLOR;
    if (!file || !png || spng_set_png_file(png.get(), file.get()) || spng_set_ihdr(png.get(), &header) ||
        spng_encode_image(png.get(), rgb.data(), rgb.size(), SPNG_FMT_PNG, SPNG_ENCODE_FINALIZE) ||
        std::fflush(file.get()))
        throw std::runtime_error("cannot write " + path);
}

} // namespace example
