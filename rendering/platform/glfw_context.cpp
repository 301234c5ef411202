#include "rendering/platform/gl_context.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

namespace fx::render {

namespace {

base::Status glfwFailure(const char* what)
{
    const char* reason = nullptr;
    glfwGetError(&reason);
    return {base::Code::GlUnsupported,
            std::string(what).append(": ").append(reason ? reason : "GLFW gives no reason")};
}

class GlfwContext final : public GlContext
{
public:
    explicit GlfwContext(GLFWwindow* window) : window_(window) {}

    /// GLFW itself stays initialised: other windows of the process may use it.
    ~GlfwContext() override { glfwDestroyWindow(window_); }

    GlLoader loader() override
    {
        return {nullptr,
                [](void*, const char* name) { return reinterpret_cast<void*>(glfwGetProcAddress(name)); }};
    }

    base::Status makeCurrent() override
    {
        glfwMakeContextCurrent(window_);
        if (glfwGetCurrentContext() == window_)
            return {};
        return glfwFailure("the window's context cannot be made current");
    }

    void swapBuffers() override { glfwSwapBuffers(window_); }

    bool closeRequested() override
    {
        glfwPollEvents();
        return glfwWindowShouldClose(window_) != 0;
    }

    std::string description() const override { return std::string("GLFW ").append(glfwGetVersionString()); }

private:
    GLFWwindow* window_;
};

} // namespace

base::Result<std::unique_ptr<GlContext>> createGlfwContext(const GlContextOptions& options)
{
    if (!glfwInit())
        return glfwFailure("GLFW cannot start");
    glfwDefaultWindowHints();
    glfwWindowHint(GLFW_CLIENT_API, GLFW_OPENGL_API);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 5);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_OPENGL_DEBUG_CONTEXT, options.debug ? GLFW_TRUE : GLFW_FALSE);
    glfwWindowHint(GLFW_VISIBLE, options.visible ? GLFW_TRUE : GLFW_FALSE);
    GLFWwindow* window = glfwCreateWindow(options.width, options.height, options.title, nullptr, nullptr);
    if (!window)
        return glfwFailure("no window with an OpenGL 4.5 core context");
    auto context = std::make_unique<GlfwContext>(window);
    if (base::Status status = context->makeCurrent(); !status)
        return status;
    return std::unique_ptr<GlContext>(std::move(context));
}

} // namespace fx::render
