#include "fxsdk/editor/program/window_editor.h"

#include "fxsdk/cli/support/interrupt.h"
#include "fxsdk/editor/program/editor_host.h"
#include "rendering/platform/gl_context.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <imgui.h>
#include <imgui_impl_glfw.h>

#include <algorithm>
#include <string>
#include <utility>

namespace fx::editor {

namespace {

/// ImGui that listens to a window.
class WindowImGui
{
public:
    explicit WindowImGui(GLFWwindow* window)
    {
        ImGui::CreateContext();
        isListening_ = ImGui_ImplGlfw_InitForOpenGL(window, true);
    }
    ~WindowImGui()
    {
        if (isListening_)
            ImGui_ImplGlfw_Shutdown();
        ImGui::DestroyContext();
    }
    WindowImGui(const WindowImGui&) = delete;
    WindowImGui& operator=(const WindowImGui&) = delete;
    bool isListening() const { return isListening_; }

private:
    bool isListening_ = false;
};

} // namespace

base::Status runWindow(std::unique_ptr<Session> session, const WindowOptions& options)
{
    render::GlContextOptions contextOptions;
    contextOptions.visible = true;
    contextOptions.width = options.width;
    contextOptions.height = options.height;
    contextOptions.title = "fx edit";
    auto context = render::createGlfwContext(contextOptions);
    if (!context)
        return {context.status().code(),
                std::string(context.status().message()) + "; without a display use --headless"};
    glfwSwapInterval(1);
    GLFWwindow* const window = glfwGetCurrentContext();
    float ofMonitor = 1.0f;
    glfwGetWindowContentScale(window, &ofMonitor, nullptr);
    const WindowImGui imgui(window);
    if (!imgui.isListening())
        return {base::Code::GlUnsupported, "Dear ImGui cannot listen to the window"};
    applyStyle(options.scale > 0.0f ? options.scale : std::max(ofMonitor, 1.0f));
    auto host = EditorHost::create(std::move(session), (*context)->loader());
    if (!host)
        return host.status();
    if (options.isLinked)
        (*host)->session().run((*host)->link(options.link));
    while (!(*context)->closeRequested() && !cli::interruptRequested()) {
        ImGui_ImplGlfw_NewFrame();
        if (base::Status status = (*host)->frame(double(ImGui::GetIO().DeltaTime), 0); !status)
            return status;
        (*context)->swapBuffers();
    }
    if (!(*host)->session().document.isDirty())
        (*host)->session().close(); // otherwise the next start offers what was not saved
    return {};
}

} // namespace fx::editor
