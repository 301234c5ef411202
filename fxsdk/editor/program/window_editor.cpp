#include "fxsdk/editor/program/window_editor.h"

#include "fxsdk/cli/support/interrupt.h"
#include "fxsdk/editor/program/editor_host.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <imgui.h>
#include <imgui_impl_glfw.h>

#include <algorithm>

namespace fx::editor {

namespace {

base::Status glfwFailure(const char* what)
{
    const char* reason = nullptr;
    glfwGetError(&reason);
    return {base::Code::GlUnsupported, std::string(what) + ": " + (reason ? reason : "GLFW gives no reason") +
                                           "; without a display use --headless"};
}

void* procAddress(void*, const char* name)
{
    return reinterpret_cast<void*>(glfwGetProcAddress(name));
}

/// A window with a current context, and ImGui that listens to it.
class Window
{
public:
    base::Status open(int width, int height, float scale)
    {
        if (!glfwInit())
            return glfwFailure("GLFW cannot start");
        glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
        glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 5);
        glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
        window_ = glfwCreateWindow(width, height, "fx edit", nullptr, nullptr);
        if (!window_)
            return glfwFailure("no window with an OpenGL 4.5 core context");
        glfwMakeContextCurrent(window_);
        glfwSwapInterval(1);
        float ofMonitor = 1.0f;
        glfwGetWindowContentScale(window_, &ofMonitor, nullptr);
        ImGui::CreateContext();
        applyStyle(scale > 0.0f ? scale : std::max(ofMonitor, 1.0f));
        hasImGui_ = ImGui_ImplGlfw_InitForOpenGL(window_, true);
        return {};
    }
    ~Window()
    {
        if (hasImGui_) {
            ImGui_ImplGlfw_Shutdown();
            ImGui::DestroyContext();
        }
        if (window_)
            glfwDestroyWindow(window_);
    }
    GLFWwindow* get() const { return window_; }

private:
    GLFWwindow* window_ = nullptr;
    bool hasImGui_ = false;
};

} // namespace

base::Status runWindow(std::unique_ptr<Session> session, int width, int height, float scale)
{
    Window window;
    if (base::Status status = window.open(width, height, scale); !status)
        return status;
    auto host = EditorHost::create(std::move(session), {nullptr, &procAddress});
    if (!host)
        return host.status();
    while (!glfwWindowShouldClose(window.get()) && !cli::interruptRequested()) {
        glfwPollEvents();
        ImGui_ImplGlfw_NewFrame();
        if (base::Status status = (*host)->frame(double(ImGui::GetIO().DeltaTime), 0); !status)
            return status;
        glfwSwapBuffers(window.get());
    }
    if (!(*host)->session().document.isDirty())
        (*host)->session().close(); // otherwise the next start offers what was not saved
    return {};
}

} // namespace fx::editor
