#include "fxsdk/editor/program/editor_host.h"

#include "fxsdk/cli/scene/picture.h"
#include "fxsdk/cli/support/atomic_file.h"
#include "fxsdk/editor/preview/why_invisible.h"
#include "rendering/gl/gl_read_texture.h"
#include "rendering/image/image.h"

#include <imgui.h>
#include <imgui_impl_opengl3.h>

#include <chrono>
#include <cstdio>
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

std::string keyOf(const PreviewFrame& frame, uint64_t revision, int64_t step)
{
    char key[320];
    std::snprintf(key, sizeof key, "%llu %lld %.17g %.17g %.17g %.17g %.17g %.17g %d %d %.9g",
                  static_cast<unsigned long long>(revision), static_cast<long long>(step),
                  frame.pose.position.x, frame.pose.position.y, frame.pose.position.z, frame.pose.target.x,
                  frame.pose.target.y, frame.pose.target.z, frame.width, frame.height,
                  double(frame.exposureEv100.value_or(-999.0f)));
    return key;
}

} // namespace

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
    const scene_file::CameraPath& camera = host->preview_->scene().camera;
    const scene_file::CameraPose pose = camera.at(0.0);
    host->session_->camera.look(pose.position, pose.target);
    host->session_->camera.fovYDegrees = camera.fovYDegrees;
    return host;
}

EditorHost::~EditorHost()
{
    if (preview_)
        ImGui_ImplOpenGL3_Shutdown();
}

/// Takes over the document and draws the picture, where something has changed. The answer to an edit is in
/// the frame after it.
void EditorHost::updatePicture()
{
    const uint64_t revision = session_->shownRevision();
    const PreviewFrame frame = frameOf(*session_, state_->pictureSize);
    std::string key = keyOf(frame, revision, session_->playback.step());
    if (key == pictureKey_)
        return;
    const Clock::time_point start = Clock::now();
    PictureState& picture = state_->picture;
    base::Status status;
    if (revision != shownRevision_) {
        status = preview_->show(session_->shownText(), session_->name(), session_->document.kind());
        picture.failure =
            status.ok() ? std::string() : "The picture shows the last valid state. " + status.message();
        shownRevision_ = revision;
    }
    status = preview_->seek(session_->playback.time());
    if (status.ok())
        status = preview_->render(frame);
    if (!status.ok())
        picture.failure = status.message();
    preview_->device().gl.Finish();
    picture.texture = preview_->texture();
    picture.particles = preview_->particles();
    picture.exposureEv100 = preview_->scene().view.exposureEv100;
    picture.milliseconds = std::chrono::duration<double, std::milli>(Clock::now() - start).count();
    pictureKey_ = std::move(key);
}

base::Status EditorHost::writePicture(const std::string& file)
{
    const PreviewFrame frame = frameOf(*session_, state_->pictureSize);
    const cli::Picture picture = cli::fromBottomUp(
        frame.width, frame.height, 3,
        render::readTexture(preview_->device(), preview_->texture(), frame.width, frame.height, 3));
    const auto png = image::writePng({picture.width, picture.height, picture.channels, picture.pixels});
    if (!png)
        return png.status();
    return cli::writeFileAtomically(file, {reinterpret_cast<const char*>(png->data()), png->size()});
}

void EditorHost::answerWhy()
{
    const std::vector<std::string> reasons = whyInvisible(session_->document, session_->soloMute(),
                                                          session_->playback.time(), preview_->particles());
    state_->why.clear();
    for (const std::string& reason : reasons)
        state_->why += "- " + reason + "\n";
}

base::Status EditorHost::frame(double seconds, uint32_t framebuffer)
{
    session_->update(seconds);
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
    if (state_->why == "?")
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
