#include "rendering/platform/gl_context.h"

#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <array>
#include <cstdio>

namespace fx::render {

namespace {

std::string eglError()
{
    char text[24];
    std::snprintf(text, sizeof text, "EGL error 0x%04X", static_cast<unsigned>(eglGetError()));
    return text;
}

class EglContext final : public GlContext
{
public:
    EglContext(EGLDisplay display, EGLContext context, std::string description)
        : display_(display), context_(context), description_(std::move(description))
    {}

    /// The display stays initialised: it is shared by all contexts of the process.
    ~EglContext() override
    {
        eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
        eglDestroyContext(display_, context_);
    }

    GlLoader loader() override
    {
        return {nullptr,
                [](void*, const char* name) { return reinterpret_cast<void*>(eglGetProcAddress(name)); }};
    }

    base::Status makeCurrent() override
    {
        if (eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_))
            return {};
        return {base::Code::GlUnsupported,
                "the EGL context cannot be made current without a surface: " + eglError()};
    }

    void swapBuffers() override {}
    std::string description() const override { return description_; }

private:
    EGLDisplay display_;
    EGLContext context_;
    std::string description_;
};

EGLDisplay surfacelessDisplay()
{
    return eglGetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, nullptr, nullptr);
}

EGLDisplay firstDeviceDisplay()
{
    const auto queryDevices =
        reinterpret_cast<PFNEGLQUERYDEVICESEXTPROC>(eglGetProcAddress("eglQueryDevicesEXT"));
    EGLDeviceEXT device = nullptr;
    EGLint count = 0;
    if (!queryDevices || !queryDevices(1, &device, &count) || count == 0)
        return EGL_NO_DISPLAY;
    return eglGetPlatformDisplay(EGL_PLATFORM_DEVICE_EXT, device, nullptr);
}

EGLDisplay defaultDisplay()
{
    return eglGetDisplay(EGL_DEFAULT_DISPLAY);
}

struct Provider
{
    const char* name;
    EGLDisplay (*open)();
};

constexpr std::array<Provider, 3> kProviders = {{{"EGL surfaceless", surfacelessDisplay},
                                                 {"EGL device", firstDeviceDisplay},
                                                 {"EGL default display", defaultDisplay}}};

base::Result<std::unique_ptr<GlContext>> openContext(const Provider& provider,
                                                     const GlContextOptions& options)
{
    const auto refuse = [&](const char* what) {
        return base::Status(base::Code::GlUnsupported,
                            std::string(provider.name).append(what).append(eglError()));
    };
    const EGLDisplay display = provider.open();
    if (display == EGL_NO_DISPLAY)
        return refuse(": no display, ");
    if (!eglInitialize(display, nullptr, nullptr))
        return refuse(": cannot be initialised, ");
    if (!eglBindAPI(EGL_OPENGL_API))
        return refuse(": no desktop OpenGL, ");

    // Surfaceless displays may have no config for windows; any will do, since nothing is drawn to a surface.
    constexpr EGLint kWanted[] = {EGL_SURFACE_TYPE, EGL_DONT_CARE, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT,
                                  EGL_NONE};
    EGLConfig config = EGL_NO_CONFIG_KHR;
    EGLint count = 0;
    if (!eglChooseConfig(display, kWanted, &config, 1, &count) || count == 0)
        config = EGL_NO_CONFIG_KHR;
    const EGLint attributes[] = {EGL_CONTEXT_MAJOR_VERSION,
                                 4,
                                 EGL_CONTEXT_MINOR_VERSION,
                                 5,
                                 EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                 EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                 EGL_CONTEXT_OPENGL_DEBUG,
                                 options.debug ? EGL_TRUE : EGL_FALSE,
                                 EGL_NONE};
    const EGLContext handle = eglCreateContext(display, config, EGL_NO_CONTEXT, attributes);
    if (handle == EGL_NO_CONTEXT)
        return refuse(": no OpenGL 4.5 core context, ");

    const char* vendor = eglQueryString(display, EGL_VENDOR);
    auto context = std::make_unique<EglContext>(
        display, handle,
        std::string(provider.name).append(" (").append(vendor ? vendor : "unknown").append(")"));
    if (base::Status status = context->makeCurrent(); !status)
        return status;
    return std::unique_ptr<GlContext>(std::move(context));
}

} // namespace

base::Result<std::unique_ptr<GlContext>> createEglContext(const GlContextOptions& options)
{
    std::string answers;
    for (const Provider& provider : kProviders) {
        base::Result<std::unique_ptr<GlContext>> context = openContext(provider, options);
        if (context)
            return context;
        answers.append(answers.empty() ? "" : "; ").append(context.status().message());
    }
    return base::Status(base::Code::GlUnsupported, "no OpenGL context without a window: " + answers);
}

} // namespace fx::render
