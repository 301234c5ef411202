#include "fxsdk/editor/program/window_editor.h"

#include "fxsdk/cli/support/interrupt.h"
#include "fxsdk/editor/program/editor_host.h"
#include "fxsdk/editor/program/window_input.h"
#include "rendering/platform/gl_context.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <imgui.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <utility>

namespace fx::editor {

namespace {

/// Such as "torch.fx.json, 3 edits, not saved - fx edit".
std::string titleOf(const Session& session)
{
    const size_t edits = session.document.history().done();
    std::string title = std::filesystem::path(session.name()).filename().string();
    if (edits > 0)
        title += ", " + std::to_string(edits) + (edits == 1 ? " edit" : " edits");
    return title + (session.document.isDirty() ? ", not saved" : "") + " - fx edit";
}

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
    const ImGuiOwner imgui;
    WindowInput input(window);
    if (!input.isListening())
        return {base::Code::GlUnsupported, "Dear ImGui cannot listen to the window"};
    applyStyle(options.scale > 0.0f ? options.scale : std::max(ofMonitor, 1.0f));
    auto host = EditorHost::create(std::move(session), (*context)->loader());
    if (!host)
        return host.status();
    if (options.isLinked)
        (*host)->session().run((*host)->link(options.link));
    std::string title;
    while (!(*context)->closeRequested() && !cli::interruptRequested()) {
        input.beginFrame();
        if (base::Status status = (*host)->frame(double(ImGui::GetIO().DeltaTime), 0); !status)
            return status;
        (*context)->swapBuffers();
        if (std::string present = titleOf((*host)->session()); present != title) {
            title = std::move(present);
            glfwSetWindowTitle(window, title.c_str());
        }
    }
    if (!(*host)->session().document.isDirty())
        (*host)->session().close(); // otherwise the next start offers what was not saved
    return {};
}

} // namespace fx::editor
