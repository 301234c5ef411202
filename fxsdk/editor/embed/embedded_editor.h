/// @file embedded_editor.h
/// The editor inside of a host's own frames of ImGui: a session, its picture and its panels. A game calls
/// draw() between ImGui::NewFrame() and ImGui::Render(), with its own window, input and renderer of ImGui. fx
/// edit does the same.
///
/// The renderer of ImGui must be that of OpenGL, whose ImTextureID is the name of a texture. The editor draws
/// its picture in the current context of OpenGL 4.5, through an fxsdk context of its own, and puts the states
/// of the host back.
///
/// Threads: [GL thread].
#pragma once

#include "fxsdk/editor/panels/editor_ui.h"
#include "fxsdk/editor/preview/budget_run.h"
#include "fxsdk/editor/preview/preview.h"
#include "fxsdk/editor/preview/reference_error.h"
#include "fxsdk/editor/preview/render_run.h"

#include <glm/vec3.hpp>

#include <memory>
#include <optional>
#include <string>

namespace fx::editor {

/// Writes a texture, whose rows begin at the bottom, as PNG.
base::Status writePng(render::GlDevice& device, uint32_t texture, int width, int height,
                      const std::string& file);

class EmbeddedEditor
{
public:
    /// Opens a session. Needs a current context of OpenGL and of ImGui.
    /// @param loader functions of the current OpenGL context
    static base::Result<std::unique_ptr<EmbeddedEditor>> create(std::unique_ptr<Session> session,
                                                                const render::GlLoader& loader);
    ~EmbeddedEditor();
    EmbeddedEditor(const EmbeddedEditor&) = delete;
    EmbeddedEditor& operator=(const EmbeddedEditor&) = delete;

    /// Updates the session and its picture, and draws the panels into a rectangle of the display.
    /// @param seconds [s] real time since the last frame
    /// @param low, size [pixel] at least 640 x 480
    void draw(double seconds, ImVec2 low, ImVec2 size);

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

    EmbeddedEditor() = default;
    void showDocument(uint64_t revision);
    void takeCamera();
    PictureKey keyOf(const PreviewFrame& frame) const;
    PictureKey keyOfMoment() const;
    void hideOldError();
    void updatePicture();
    void updateBefore();
    void updateError();
    base::Status startError();
    void showError(const ErrorPicture& error);
    void updateBudget();
    base::Status startBudget();
    void updateRender();
    base::Status startRender();
    void answerWhy();
    void answerRequests();
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
    double errorTime_ = 0.0;                  ///< [s] of the timeline that it compares
    std::optional<PictureKey> errorKey_; ///< of the moment that it compares; empty: the picture has changed
    uint32_t errorTexture_ = 0;

    std::unique_ptr<BudgetRun> budget_; ///< the last one; its report has textures
    uint64_t budgetRevision_ = 0;       ///< Session::shownRevision() that it measures
    std::unique_ptr<RenderRun> render_; ///< while it runs
    render::GlLoader loader_;
};

} // namespace fx::editor
