#include "fxsdk/editor/program/editor_host.h"

#include <imgui.h>
#include <imgui_impl_opengl3.h>

#include <utility>

namespace fx::editor {

ImGuiOwner::ImGuiOwner()
{
    ImGui::CreateContext();
}

ImGuiOwner::~ImGuiOwner()
{
    ImGui::DestroyContext();
}

base::Result<std::unique_ptr<EditorHost>> EditorHost::create(std::unique_ptr<Session> session,
                                                             const render::GlLoader& loader)
{
    std::unique_ptr<EditorHost> host(new EditorHost);
    auto editor = EmbeddedEditor::create(std::move(session), loader);
    if (!editor)
        return editor.status();
    host->editor_ = std::move(*editor);
    host->hasRenderer_ = ImGui_ImplOpenGL3_Init("#version 330 core");
    if (!host->hasRenderer_)
        return base::Status(base::Code::GlUnsupported,
                            "the OpenGL renderer of Dear ImGui cannot start: libGL.so is missing");
    return host;
}

EditorHost::~EditorHost()
{
    if (hasRenderer_)
        ImGui_ImplOpenGL3_Shutdown();
}

base::Status EditorHost::frame(double seconds, uint32_t framebuffer)
{
    ImGui_ImplOpenGL3_NewFrame();
    ImGui::NewFrame();
    editor_->draw(seconds, {0.0f, 0.0f}, ImGui::GetIO().DisplaySize);
    ImGui::Render();
    const render::GlFunctions& gl = preview().device().gl;
    constexpr float kBlack[4] = {0.0f, 0.0f, 0.0f, 1.0f};
    gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    gl.ClearNamedFramebufferfv(framebuffer, GL_COLOR, 0, kBlack);
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
    return {};
}

} // namespace fx::editor
