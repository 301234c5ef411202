#include "hello_window.h"

#include "offscreen_gl.h"

#ifdef HELLO_WITH_WINDOW
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#endif

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>

namespace {

using Clock = std::chrono::steady_clock;

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

#ifdef HELLO_WITH_WINDOW
/// A window on the screen with a current OpenGL 4.5 core context.
class ScreenWindow
{
public:
    ScreenWindow()
    {
        if (!glfwInit())
            throw std::runtime_error("no screen; use --headless");
        glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
        glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 5);
        glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
        glfwWindowHint(GLFW_RESIZABLE, GLFW_FALSE);
        window_ = glfwCreateWindow(kWidth, kHeight, "fxsdk: hello", nullptr, nullptr);
        if (!window_) {
            glfwTerminate();
            throw std::runtime_error("no window with OpenGL 4.5; use --headless");
        }
        glfwMakeContextCurrent(window_);
        glfwSwapInterval(1);
    }
    ~ScreenWindow() { glfwTerminate(); }
    ScreenWindow(const ScreenWindow&) = delete;
    ScreenWindow& operator=(const ScreenWindow&) = delete;

    static void* findFunction(const char* name) { return reinterpret_cast<void*>(glfwGetProcAddress(name)); }
    bool closes() const
    {
        glfwPollEvents();
        return glfwWindowShouldClose(window_) != 0;
    }
    void swap() const { glfwSwapBuffers(window_); }

private:
    GLFWwindow* window_ = nullptr;
};
#else
class ScreenWindow
{
public:
    ScreenWindow() { throw std::runtime_error("this build has no windows; use --headless"); }
    static void* findFunction(const char*) { return nullptr; }
    static bool closes() { return true; }
    static void swap() {}
};
#endif

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

} // namespace

struct HelloWindow
{
    explicit HelloWindow(const Options& given) : options(given)
    {
        if (options.isHeadless)
            offscreen.emplace();
        else
            screen.emplace();
        picture.emplace(kWidth, kHeight);
    }

    Options options;
    std::optional<example::OffscreenGl> offscreen; ///< one of the two
    std::optional<ScreenWindow> screen;
    std::optional<example::Picture> picture; ///< the game's picture and its depth; here nothing occludes
    Clock::time_point last = Clock::now();
    long frame = 0;
};

HelloWindow* helloOpen(int argumentCount, char** arguments)
{
    const Options options = parse(argumentCount, arguments);
    if (!options.isUnderstood) {
        helloFail("usage: 00_hello [--headless] [--frames N] [--output FILE.png]");
        return nullptr;
    }
    try {
        return std::make_unique<HelloWindow>(options).release();
    } catch (const std::exception& error) {
        helloFail(error.what());
        return nullptr;
    }
}

void* helloGetProcAddress(void* user, const char* name)
{
    return static_cast<HelloWindow*>(user)->screen ? ScreenWindow::findFunction(name)
                                                   : example::findOffscreenFunction(nullptr, name);
}

int helloBeginFrame(HelloWindow* window, FxFrameDef* ioFrame)
{
    const bool isHeadless = window->options.isHeadless;
    if (isHeadless ? window->frame >= window->options.frames : window->screen->closes())
        return 0;
    window->picture->clear(kSky);
    setCamera(*ioFrame);
    ioFrame->target = isHeadless ? FX_TARGET_TEXTURE : FX_TARGET_FRAMEBUFFER;
    ioFrame->colorTexture = window->picture->color();
    ioFrame->depthTexture = window->picture->depth();
    ioFrame->width = kWidth;
    ioFrame->height = kHeight;
    const Clock::time_point now = Clock::now();
    ioFrame->deltaTime = isHeadless ? 1.0 / 60.0 : std::chrono::duration<double>(now - window->last).count();
    window->last = now;
    ++window->frame;
    return 1;
}

void helloEndFrame(HelloWindow* window)
{
    if (window->screen)
        window->screen->swap();
}

int helloClose(HelloWindow* window)
{
    const std::unique_ptr<HelloWindow> owned(window);
    try {
        if (!owned->options.output.empty())
            owned->picture->writePng(owned->options.output);
    } catch (const std::exception& error) {
        return helloFail(error.what());
    }
    return EXIT_SUCCESS;
}

int helloFail(const char* message)
{
    if (*message) // otherwise the reason has been printed already
        std::fprintf(stderr, "00_hello: %s\n", message);
    return EXIT_FAILURE;
}
