/// @file editor_host.h
/// Frames of the editor as a program: the embedded editor with the OpenGL renderer of ImGui, over the whole
/// display. The window and the program without a display use the same frames.
///
/// Threads: [GL thread].
#pragma once

#include "fxsdk/editor/embed/embedded_editor.h"

#include <memory>
#include <string>

namespace fx::editor {

/// A context of ImGui.
class ImGuiOwner
{
public:
    ImGuiOwner();
    ~ImGuiOwner();
    ImGuiOwner(const ImGuiOwner&) = delete;
    ImGuiOwner& operator=(const ImGuiOwner&) = delete;
};

class EditorHost
{
public:
    /// Needs a current context of OpenGL and of ImGui.
    static base::Result<std::unique_ptr<EditorHost>> create(std::unique_ptr<Session> session,
                                                            const render::GlLoader& loader);
    ~EditorHost();
    EditorHost(const EditorHost&) = delete;
    EditorHost& operator=(const EditorHost&) = delete;

    /// Draws a frame to a framebuffer of the size that ImGui's io.DisplaySize states. ImGui::NewFrame() is
    /// called within. @param seconds [s] real time since the last frame
    base::Status frame(double seconds, uint32_t framebuffer);

    base::Status link(const std::string& address) { return editor_->link(address); }
    PanelState& state() { return editor_->state(); }
    Session& session() { return editor_->session(); }
    Preview& preview() { return editor_->preview(); }
    uint64_t pictureRevision() const { return editor_->pictureRevision(); }

private:
    EditorHost() = default;

    std::unique_ptr<EmbeddedEditor> editor_;
    bool hasRenderer_ = false;
};

} // namespace fx::editor
