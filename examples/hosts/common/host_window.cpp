#include "host_window.h"

#include "offscreen_gl.h"

#include <epoxy/gl.h>
#ifdef HOST_WITH_GLFW
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#endif

#include <cstdio>
#include <exception>
#include <optional>

namespace {

std::optional<example::OffscreenGl> offscreen;
#ifdef HOST_WITH_GLFW
GLFWwindow* window = nullptr;
#endif

} // namespace

int hostOpenOffscreen(void)
{
    try {
        offscreen.emplace();
        return 1;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 0;
    }
}

void hostCloseOffscreen(void)
{
    offscreen.reset();
}

int hostOpenWindow(HostOptions* ioOptions, const char* title)
{
    if (ioOptions->output)
        return hostOpenOffscreen();
#ifdef HOST_WITH_GLFW
    if (glfwInit()) {
        glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
        glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 5);
        glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
        glfwWindowHint(GLFW_RESIZABLE, GLFW_FALSE);
        window = glfwCreateWindow(ioOptions->width, ioOptions->height, title, nullptr, nullptr);
    }
    if (window) {
        glfwMakeContextCurrent(window);
        glfwSwapInterval(1);
        glfwGetFramebufferSize(window, &ioOptions->width, &ioOptions->height);
        return 1;
    }
    std::fprintf(stderr, "no window with OpenGL 4.5; use --headless FILE.png\n");
#else
    std::fprintf(stderr, "%s: built without GLFW; use --headless FILE.png\n", title);
#endif
    return 0;
}

int hostPresent([[maybe_unused]] unsigned framebuffer, [[maybe_unused]] int width,
                [[maybe_unused]] int height)
{
#ifdef HOST_WITH_GLFW
    if (window) {
        glBlitNamedFramebuffer(framebuffer, 0, 0, 0, width, height, 0, 0, width, height, GL_COLOR_BUFFER_BIT,
                               GL_NEAREST);
        glfwSwapBuffers(window);
        glfwPollEvents();
        return !glfwWindowShouldClose(window);
    }
#endif
    return 1;
}

void hostCloseWindow(void)
{
    offscreen.reset();
#ifdef HOST_WITH_GLFW
    if (window)
        glfwTerminate();
    window = nullptr;
#endif
}
