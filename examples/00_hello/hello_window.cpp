#include "hello_window.h"

#include "rendering/gl/gl_device.h"
#include "rendering/gl/gl_read_texture.h"
#include "rendering/gl/gl_texture.h"
#include "rendering/image/image.h"
#include "rendering/platform/gl_context.h"

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <memory>
#include <string>

namespace {

using Clock = std::chrono::steady_clock;
using fx::base::Result;
using fx::base::Status;

constexpr int kWidth = 960;
constexpr int kHeight = 540;
constexpr float kSky[4] = {0.10f, 0.13f, 0.18f, 1.0f}; // exposed values of the picture before the effects

struct Options
{
    bool isHeadless = false;
    long frames = 90;
    std::string output;
    bool isUnderstood = true;
};

Options parse(int argumentCount, char** arguments)
{
    Options options;
    for (int i = 1; i < argumentCount; ++i) {
        const bool hasValue = i + 1 < argumentCount;
        if (std::strcmp(arguments[i], "--headless") == 0)
            options.isHeadless = true;
        else if (std::strcmp(arguments[i], "--frames") == 0 && hasValue)
            options.frames = std::strtol(arguments[++i], nullptr, 10);
        else if (std::strcmp(arguments[i], "--output") == 0 && hasValue)
            options.output = arguments[++i];
        else
            options.isUnderstood = false;
    }
    options.isUnderstood = options.isUnderstood && options.frames > 0;
    return options;
}

Result<std::unique_ptr<fx::render::GlContext>> openContext(bool isHeadless)
{
    fx::render::GlContextOptions options;
    options.visible = true;
    options.width = kWidth;
    options.height = kHeight;
    options.title = "fxsdk: hello";
    if (isHeadless)
        return fx::render::createEglContext(options);
#ifdef HELLO_WITH_WINDOW
    return fx::render::createGlfwContext(options);
#else
    return Status(fx::base::Code::GlUnsupported, "this build has no windows; use --headless");
#endif
}

} // namespace

struct HelloWindow
{
    Options options;
    std::unique_ptr<fx::render::GlContext> context;
    std::unique_ptr<fx::render::GlDevice> device;
    fx::render::GlTexture color; ///< the game's picture
    fx::render::GlTexture depth; ///< and its depth; here nothing occludes
    Clock::time_point last = Clock::now();
    long frame = 0;
};

namespace {

Status open(HelloWindow& window)
{
    auto context = openContext(window.options.isHeadless);
    if (!context)
        return context.status();
    window.context = std::move(*context);
    auto device = fx::render::GlDevice::create(window.context->loader(), std::pmr::get_default_resource());
    if (!device)
        return device.status();
    window.device = std::move(*device);
    auto color = fx::render::GlTexture::create(*window.device, kWidth, kHeight, GL_RGBA32F, "picture");
    auto depth =
        fx::render::GlTexture::create(*window.device, kWidth, kHeight, GL_DEPTH_COMPONENT32F, "depth");
    if (!color || !depth)
        return color ? depth.status() : color.status();
    window.color = std::move(*color);
    window.depth = std::move(*depth);
    return {};
}

/// Looks horizontally from 16 m away and 3 m up, 50 degrees of height.
void setCamera(FxFrameDef& frame)
{
    constexpr float kCotangent = 2.1445f; // of half the angle
    constexpr float kNear = 0.1f;
    frame.origin[1] = 3.0;
    frame.origin[2] = 16.0;
    std::memset(frame.projection, 0, sizeof frame.projection);
    frame.projection[0] = kCotangent * float(kHeight) / float(kWidth);
    frame.projection[5] = kCotangent;
    frame.projection[10] = -1.0f; // infinite far plane
    frame.projection[11] = -1.0f;
    frame.projection[14] = -2.0f * kNear;
}

Status writePicture(HelloWindow& window)
{
    const std::vector<float> texels =
        fx::render::readTexture(*window.device, window.color.name(), kWidth, kHeight, 3);
    fx::image::Image image{kWidth, kHeight, 3, {}};
    for (int y = kHeight - 1; y >= 0; --y) { // GL's rows begin at the bottom
        const auto row = texels.begin() + std::ptrdiff_t(y) * kWidth * 3;
        image.pixels.insert(image.pixels.end(), row, row + kWidth * 3);
    }
    const auto png = fx::image::writePng(image);
    if (!png)
        return png.status();
    std::ofstream file(window.options.output, std::ios::binary);
    file.write(reinterpret_cast<const char*>(png->data()), std::streamsize(png->size()));
    file.close();
    return file ? Status() : Status(fx::base::Code::Io, "cannot write " + window.options.output);
}

} // namespace

HelloWindow* helloOpen(int argumentCount, char** arguments)
{
    auto window = std::make_unique<HelloWindow>();
    window->options = parse(argumentCount, arguments);
    if (!window->options.isUnderstood) {
        helloFail("usage: 00_hello [--headless] [--frames N] [--output FILE.png]");
        return nullptr;
    }
    if (const Status status = open(*window); !status) {
        helloFail(status.message().c_str());
        return nullptr;
    }
    return window.release();
}

void* helloGetProcAddress(void* user, const char* name)
{
    const fx::render::GlLoader loader = static_cast<HelloWindow*>(user)->context->loader();
    return loader.getProcAddress(loader.user, name);
}

int helloBeginFrame(HelloWindow* window, FxFrameDef* ioFrame)
{
    const bool stops = window->options.isHeadless ? window->frame >= window->options.frames
                                                  : window->context->closeRequested();
    if (stops)
        return 0;
    const float farPlane = 1.0f;
    window->device->gl.ClearTexImage(window->color.name(), 0, GL_RGBA, GL_FLOAT, kSky);
    window->device->gl.ClearTexImage(window->depth.name(), 0, GL_DEPTH_COMPONENT, GL_FLOAT, &farPlane);
    setCamera(*ioFrame);
    ioFrame->target = window->options.isHeadless ? FX_TARGET_TEXTURE : FX_TARGET_FRAMEBUFFER;
    ioFrame->colorTexture = window->color.name();
    ioFrame->depthTexture = window->depth.name();
    ioFrame->width = kWidth;
    ioFrame->height = kHeight;
    const Clock::time_point now = Clock::now();
    ioFrame->deltaTime =
        window->options.isHeadless ? 1.0 / 60.0 : std::chrono::duration<double>(now - window->last).count();
    window->last = now;
    ++window->frame;
    return 1;
}

void helloEndFrame(HelloWindow* window)
{
    window->context->swapBuffers();
}

int helloClose(HelloWindow* window)
{
    const std::unique_ptr<HelloWindow> owned(window);
    const Status status = window->options.output.empty() ? Status() : writePicture(*window);
    return status ? EXIT_SUCCESS : helloFail(status.message().c_str());
}

int helloFail(const char* message)
{
    if (*message) // otherwise the reason has been printed already
        std::fprintf(stderr, "00_hello: %s\n", message);
    return EXIT_FAILURE;
}
