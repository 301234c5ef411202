/// @file editor_host.h
/// Runs the editor in an OpenGL context: a session, its picture and its panels, frame by frame. The window
/// and the program without a display use the same frames.
///
/// Threads: [GL thread].
#pragma once

#include "fxsdk/editor/panels/editor_ui.h"
#include "fxsdk/editor/preview/preview.h"
#include "fxsdk/editor/preview/reference_error.h"

#include <glm/vec3.hpp>

#include <memory>
#include <optional>
#include <string>

namespace fx::editor {

/// Writes a texture, whose rows begin at the bottom, as PNG.
base::Status writePng(render::GlDevice& device, uint32_t texture, int width, int height,
                      const std::string& file);

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

    /// Shows each valid edit in a running game from now on. Presets only.
    /// @param address see link::parseAddress(); empty: the only game that is running
    /// @return InvalidArgument, NotFound, Capacity (several games are running)
    base::Status link(const std::string& address);

    PanelState& state() { return *state_; }
    Session& session() { return *session_; }
    Preview& preview() { return *preview_; }
    /// Revision of the session that the picture of the last frame shows.
    uint64_t pictureRevision() const { return shownRevision_; }

private:
    /// What a picture depends on.
    struct PictureKey
    {
        uint64_t revision;
        int64_t step;
        glm::dvec3 position;
        glm::dvec3 target;
        float fovYDegrees;
        int width;
        int height;
        std::optional<float> exposureEv100;
        OverlayChoice overlays;
        bool operator==(const PictureKey&) const = default;
    };

    EditorHost() = default;
    void showDocument(uint64_t revision);
    void takeCamera();
    PictureKey keyOf(const PreviewFrame& frame) const;
    void updatePicture();
    void updateBefore();
    void updateError();
    base::Status startError();
    void showError(const ErrorPicture& error);
    base::Status writePicture(const std::string& file);
    void answerWhy();
    void updateLink(double seconds);

    std::unique_ptr<Session> session_;
    std::unique_ptr<Preview> preview_;
    std::unique_ptr<PanelState> state_;
    uint64_t shownRevision_ = 0;
    std::string shownStage_;               ///< of Session::stage()
    uint64_t offeredRevision_ = 0;         ///< of the document, for the running game
    std::optional<PictureKey> pictureKey_; ///< of the last picture

    std::unique_ptr<Preview> before_; ///< of the comparison, from its first picture on
    Json beforeState_;                ///< that it shows
    uint64_t beforeChoice_ = 0;       ///< Session::choiceRevision() that it shows
    std::optional<PictureKey> beforeKey_;

    std::unique_ptr<ReferenceRun> reference_; ///< while it runs
    uint32_t errorTexture_ = 0;
    render::GlLoader loader_;
};

} // namespace fx::editor
