#include "fxsdk/editor/program/editor_host.h"

#include "fxsdk/cli/scene/picture.h"
#include "fxsdk/cli/support/atomic_file.h"
#include "fxsdk/editor/panels/panels.h"
#include "fxsdk/editor/preview/why_invisible.h"
#include "rendering/gl/gl_read_texture.h"
#include "rendering/image/image.h"

#include <imgui.h>
#include <imgui_impl_opengl3.h>

#include <algorithm>
#include <chrono>
#include <utility>

namespace fx::editor {

namespace {

using Clock = std::chrono::steady_clock;

PreviewFrame frameOf(const Session& session, ImVec2 size)
{
    PreviewFrame frame;
    frame.pose.position = session.camera.position();
    frame.pose.target = session.camera.target();
    frame.fovYDegrees = session.camera.fovYDegrees;
    frame.width = int(size.x);
    frame.height = int(size.y);
    frame.exposureEv100 = session.exposureEv100;
    return frame;
}

} // namespace

base::Status writePng(render::GlDevice& device, uint32_t texture, int width, int height,
                      const std::string& file)
{
    const cli::Picture picture =
        cli::fromBottomUp(width, height, 3, render::readTexture(device, texture, width, height, 3));
    const auto png = image::writePng({picture.width, picture.height, picture.channels, picture.pixels});
    if (!png)
        return png.status();
    return cli::writeFileAtomically(file, {reinterpret_cast<const char*>(png->data()), png->size()});
}

base::Result<std::unique_ptr<EditorHost>> EditorHost::create(std::unique_ptr<Session> session,
                                                             const render::GlLoader& loader)
{
    std::unique_ptr<EditorHost> host(new EditorHost);
    auto preview = Preview::create(loader);
    if (!preview)
        return preview.status();
    if (!ImGui_ImplOpenGL3_Init("#version 330 core"))
        return base::Status(base::Code::GlUnsupported,
                            "the OpenGL renderer of Dear ImGui cannot start: libGL.so is missing");
    host->session_ = std::move(session);
    host->preview_ = std::move(*preview);
    host->state_ = std::make_unique<PanelState>(*host->session_);
    host->updatePicture();
    return host;
}

EditorHost::~EditorHost()
{
    if (preview_)
        ImGui_ImplOpenGL3_Shutdown();
}

/// Shows the document; the first that is valid also places the camera.
void EditorHost::showDocument(uint64_t revision)
{
    const bool hadScene = preview_->hasScene();
    const base::Status status =
        preview_->show(session_->shownText(), session_->name(), session_->document.kind());
    shownRevision_ = revision;
    state_->picture.failure.clear();
    if (!status.ok())
        state_->picture.failure =
            (hadScene ? "The picture shows the last valid state. " : "There is no picture yet. ") +
            status.message();
    if (hadScene || !preview_->hasScene())
        return;
    const scene_file::CameraPath& camera = preview_->scene().camera;
    const scene_file::CameraPose pose = camera.at(0.0);
    session_->camera.look(pose.position, pose.target);
    session_->camera.fovYDegrees = camera.fovYDegrees;
}

/// Takes over the document and draws the picture, where something has changed. The answer to an edit is in
/// the frame after it.
void EditorHost::updatePicture()
{
    const Clock::time_point start = Clock::now();
    if (const uint64_t revision = session_->shownRevision(); revision != shownRevision_)
        showDocument(revision);
    const PreviewFrame frame = frameOf(*session_, state_->pictureSize);
    const PictureKey key{shownRevision_,    session_->playback.step(), frame.pose.position,
                         frame.pose.target, frame.fovYDegrees,         frame.width,
                         frame.height,      frame.exposureEv100};
    if (key == pictureKey_ || !preview_->hasScene())
        return;
    pictureKey_ = key;
    PictureState& picture = state_->picture;
    base::Status status = preview_->seek(session_->playback.time());
    if (status.ok())
        status = preview_->render(frame);
    if (!status.ok())
        picture.failure = status.message();
    preview_->device().gl.Finish();
    picture.texture = preview_->texture();
    picture.particles = preview_->particles();
    picture.exposureEv100 = preview_->scene().view.exposureEv100;
    picture.milliseconds = std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

base::Status EditorHost::writePicture(const std::string& file)
{
    const PreviewFrame frame = frameOf(*session_, state_->pictureSize);
    return writePng(preview_->device(), preview_->texture(), frame.width, frame.height, file);
}

void EditorHost::answerWhy()
{
    std::vector<std::string> reasons =
        whyInvisible(session_->document, session_->soloMute(), session_->playback.time());
    for (std::string& cause : preview_->causes(frameOf(*session_, state_->pictureSize)))
        reasons.push_back(std::move(cause));
    state_->asksWhy = false;
    state_->why.clear();
    for (const std::string& reason : reasons)
        state_->why += "- " + reason + "\n";
}

base::Status EditorHost::link(const std::string& address)
{
    if (session_->document.kind() != DocumentKind::Preset)
        return {base::Code::InvalidArgument, "a running game shows presets (*.fx.json), no scenes"};
    if (!address.empty()) {
        const base::Result<link::Address> parsed = link::parseAddress(address);
        if (parsed)
            startLink(*state_, *parsed);
        return parsed.status();
    }
    const std::vector<link::Game> games = link::findGames();
    if (games.size() != 1)
        return {games.empty() ? base::Code::NotFound : base::Code::Capacity,
                std::to_string(games.size()) + " games are running in " + link::linkFolder() +
                    "; write --link ADDRESS (`fx link list` lists them)"};
    startLink(*state_, games.front().address);
    return {};
}

/// Offers each valid state of the document to the game, which gets the newest as fast as it takes them.
void EditorHost::updateLink(double seconds)
{
    link::LiveEdit& edit = state_->link.edit;
    if (edit.state() == link::LinkState::Off) {
        offeredRevision_ = 0;
        return;
    }
    const uint64_t revision = session_->document.revision();
    const auto isError = [](const DocumentFinding& finding) { return !finding.diagnostic.warning; };
    if (revision != offeredRevision_) {
        offeredRevision_ = revision;
        const std::vector<DocumentFinding>& findings = session_->findings();
        if (std::none_of(findings.begin(), findings.end(), isError))
            edit.offer(session_->document.text(), revision);
    }
    edit.update(seconds);
}

base::Status EditorHost::frame(double seconds, uint32_t framebuffer)
{
    session_->update(seconds);
    updateLink(seconds); // before the picture, which takes longer
    updatePicture();
    ImGui_ImplOpenGL3_NewFrame();
    ImGui::NewFrame();
    drawEditor(*state_);
    ImGui::Render();
    const render::GlFunctions& gl = preview_->device().gl;
    constexpr float kBlack[4] = {0.0f, 0.0f, 0.0f, 1.0f};
    gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    gl.ClearNamedFramebufferfv(framebuffer, GL_COLOR, 0, kBlack);
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
    if (state_->asksWhy)
        answerWhy();
    if (state_->renderTo.empty())
        return {};
    const std::string file = std::exchange(state_->renderTo, {});
    session_->run(writePicture(file));
    if (session_->message.empty())
        session_->message = "Wrote " + file;
    return {};
}

} // namespace fx::editor
