#include "fxsdk/editor/embed/embedded_editor.h"

#include "fxsdk/cli/scene/picture.h"
#include "fxsdk/cli/support/atomic_file.h"
#include "fxsdk/editor/panels/panels.h"
#include "fxsdk/editor/preview/why_invisible.h"
#include "fxsdk/scene_file/stages.h"
#include "rendering/gl/gl_read_texture.h"
#include "rendering/gl/gl_unpack_scope.h"
#include "rendering/image/image.h"

#include <imgui.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <map>
#include <utility>

namespace fx::editor {

namespace {

using Clock = std::chrono::steady_clock;

constexpr int kErrorWidth = 160; // [pixel] of the comparison with the reference renderer
constexpr const char* kOldError = ", before the last change of the picture";

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

base::Result<std::unique_ptr<EmbeddedEditor>> EmbeddedEditor::create(std::unique_ptr<Session> session,
                                                                     const render::GlLoader& loader)
{
    std::unique_ptr<EmbeddedEditor> host(new EmbeddedEditor);
    auto preview = Preview::create(loader);
    if (!preview)
        return preview.status();
    host->session_ = std::move(session);
    host->loader_ = loader;
    host->preview_ = std::move(*preview);
    host->state_ = std::make_unique<PanelState>(*host->session_);
    host->updatePicture();
    return host;
}

EmbeddedEditor::~EmbeddedEditor()
{
    reference_.reset();
    render_.reset();
    budget_.reset();
    if (preview_ && errorTexture_ != 0)
        preview_->device().gl.DeleteTextures(1, &errorTexture_);
}

/// Shows the document. The first that is valid also places the camera, and so does an edit of the camera.
void EmbeddedEditor::showDocument(uint64_t revision)
{
    const bool hadScene = preview_->hasScene();
    preview_->setMotion(session_->motion());
    const base::Status status =
        preview_->show(session_->shownText(), session_->name(), session_->document.kind());
    shownRevision_ = revision;
    state_->picture.failure.clear();
    if (!status.ok())
        state_->picture.failure =
            (hadScene ? "The picture shows the last valid state. " : "There is no picture yet. ") +
            status.message();
    const bool hasNewCamera = status.ok() && session_->followPreview() && preview_->hasCamera();
    const bool hasNewStage = shownStage_ != session_->stage().name;
    shownStage_ = session_->stage().name;
    const scene_file::Stage* const stage = scene_file::findStage(shownStage_);
    const bool isInside =
        stage && Json::parse(stage->members).contains("camera"); // other places see it from outside
    if (preview_->hasScene() && (!hadScene || (hasNewCamera && !isInside) || (hasNewStage && isInside)))
        takeCamera();
}

void EmbeddedEditor::takeCamera()
{
    const scene_file::CameraPath& camera = preview_->scene().camera;
    const scene_file::CameraPose pose = camera.at(session_->playback.time());
    session_->camera.look(pose.position, pose.target);
    session_->camera.fovYDegrees = camera.fovYDegrees;
}

EmbeddedEditor::PictureKey EmbeddedEditor::keyOf(const PreviewFrame& frame) const
{
    return {shownRevision_,    session_->playback.step(), frame.pose.position,
            frame.pose.target, frame.fovYDegrees,         frame.width,
            frame.height,      frame.exposureEv100,       session_->overlays};
}

/// Of the present picture without its overlays.
EmbeddedEditor::PictureKey EmbeddedEditor::keyOfMoment() const
{
    PictureKey key = keyOf(frameOf(*session_, state_->pictureSize));
    key.overlays = {};
    return key;
}

/// An error belongs to one moment, camera and state of the document.
void EmbeddedEditor::hideOldError()
{
    if (!errorKey_ || *errorKey_ == keyOfMoment())
        return;
    errorKey_.reset();
    state_->error.isShown = false;
    if (!reference_)
        state_->error.text += kOldError;
}

/// Takes over the document and draws the picture, where something has changed. The answer to an edit is in
/// the frame after it.
void EmbeddedEditor::updatePicture()
{
    const Clock::time_point start = Clock::now();
    if (const uint64_t revision = session_->shownRevision(); revision != shownRevision_)
        showDocument(revision);
    if (session_->followsCamera && session_->hasCameraKeys() && preview_->hasScene())
        takeCamera();
    const PreviewFrame frame = frameOf(*session_, state_->pictureSize);
    const PictureKey key = keyOf(frame);
    hideOldError();
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
    picture.elements = preview_->elementCounts();
    picture.placement = preview_->placement();
    picture.overlays = preview_->overlays(session_->overlays, frame);
    picture.exposureEv100 = preview_->scene().view.exposureEv100;
    picture.milliseconds = std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

/// The picture of before has the time and the camera of the present one.
void EmbeddedEditor::updateBefore()
{
    PictureState& picture = state_->picture;
    if (!session_->comparison.isShown || !preview_->hasScene())
        return;
    if (!before_) {
        auto before = Preview::create(loader_);
        if (!before) {
            session_->message = "There is no picture of before. " + before.status().message();
            session_->comparison.isShown = false;
            return;
        }
        before_ = std::move(*before);
    }
    const uint64_t choice = session_->choiceRevision();
    if (beforeState_ != session_->stateBefore() || beforeChoice_ != choice || !before_->hasScene()) {
        beforeState_ = session_->stateBefore();
        beforeChoice_ = choice;
        before_->setMotion(session_->motion());
        const base::Status status =
            before_->show(session_->textOf(beforeState_), session_->name(), session_->document.kind());
        picture.beforeFailure =
            status.ok() ? std::string() : "There is no picture of before. " + status.message();
        beforeKey_.reset();
    }
    const PreviewFrame frame = frameOf(*session_, state_->pictureSize);
    PictureKey key = keyOf(frame);
    key.revision = 0;
    if (key == beforeKey_ || !before_->hasScene())
        return;
    beforeKey_ = key;
    base::Status status = before_->seek(session_->playback.time());
    if (status.ok())
        status = before_->render(frame);
    if (!status.ok())
        picture.beforeFailure = status.message();
    picture.beforeTexture = before_->texture();
}

/// Draws the present moment small and as light, and begins the reference of it. Stops playing, so that the
/// picture stays at this moment.
base::Status EmbeddedEditor::startError()
{
    session_->playback.isPlaying = false;
    if (const uint64_t revision = session_->shownRevision(); revision != shownRevision_)
        showDocument(revision);
    errorTime_ = session_->playback.time();
    errorKey_ = keyOfMoment();
    pictureKey_.reset(); // the next frame draws the picture again
    if (base::Status status = preview_->seek(errorTime_); !status)
        return status;
    PreviewFrame frame = frameOf(*session_, state_->pictureSize);
    frame.height = std::max(frame.height * kErrorWidth / std::max(frame.width, 1), 8);
    frame.width = kErrorWidth;
    frame.isLinear = true;
    if (base::Status status = preview_->render(frame); !status)
        return status;
    cli::Picture small = cli::fromBottomUp(
        frame.width, frame.height, 3,
        render::readTexture(preview_->device(), preview_->texture(), frame.width, frame.height, 3));
    reference_ =
        std::make_unique<ReferenceRun>(preview_->scene(), errorTime_, frame, std::move(small.pixels));
    return {};
}

void EmbeddedEditor::showError(const ErrorPicture& error)
{
    const render::GlFunctions& gl = preview_->device().gl;
    if (errorTexture_ != 0)
        gl.DeleteTextures(1, &errorTexture_);
    gl.CreateTextures(GL_TEXTURE_2D, 1, &errorTexture_);
    gl.TextureStorage2D(errorTexture_, 1, GL_RGBA8, error.width, error.height);
    gl.TextureParameteri(errorTexture_, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    gl.TextureParameteri(errorTexture_, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    const std::vector<uint8_t> colors = errorColors(error);
    const render::GlUnpackScope unpack(gl);
    gl.TextureSubImage2D(errorTexture_, 0, 0, 0, error.width, error.height, GL_RGBA, GL_UNSIGNED_BYTE,
                         colors.data());
    ErrorState& state = state_->error;
    state.texture = errorTexture_;
    state.isShown = errorKey_.has_value();
    char text[160];
    std::snprintf(text, sizeof text, "error of %.2f s, %dx%d: mean %.4f, p99 %.4f, largest %.4f of white",
                  errorTime_, error.width, error.height, error.mean, error.p99, error.largest);
    state.text = text;
    if (error.notFinite > 0)
        state.text += ", " + std::to_string(error.notFinite) + " pixels are no numbers";
    if (!state.isShown)
        state.text += kOldError;
}

void EmbeddedEditor::updateError()
{
    ErrorState& state = state_->error;
    if (std::exchange(state.isAsked, false) && !reference_ && preview_->hasScene()) {
        const base::Status status = startError();
        state.text = status.message();
        if (!status.ok())
            errorKey_.reset();
    }
    if (std::exchange(state.isStopped, false) && reference_)
        reference_->stop();
    state.isRunning = reference_ != nullptr;
    if (!reference_)
        return;
    state.progress = reference_->progress();
    if (!reference_->isDone())
        return;
    if (const auto& result = reference_->result(); result) {
        showError(*result);
    } else {
        state.text = result.status().message();
        errorKey_.reset();
    }
    reference_.reset();
    state.isRunning = false;
}

/// The texts that show one element each, and the one that shows none.
base::Status EmbeddedEditor::startBudget()
{
    const Session& session = *session_;
    BudgetSubject subject;
    subject.text = session.shownText();
    subject.name = session.name();
    subject.kind = session.document.kind();
    subject.time = session.playback.time();
    subject.end = session.playback.end;
    subject.frame = frameOf(session, state_->pictureSize);
    subject.motion = session.motion();
    if (subject.kind == DocumentKind::Preset) {
        const Json& schema = session.document.schema();
        const auto textWith = [&](const SoloMute& choice) {
            return writeJson(
                onStage(choice.shown(session.document.json(), schema), subject.kind, session.stage()));
        };
        SoloMute none;
        std::map<std::string, SoloMute> without; // by technique
        for (const std::string& element : soloElements(session.document.json(), schema)) {
            SoloMute one;
            one.setSolo(element, true);
            subject.elements.emplace_back(element, textWith(one));
            none.setMuted(element, true);
            without[Json::json_pointer(element).parent_pointer().to_string()].setMuted(element, true);
        }
        for (const auto& [technique, choice] : without)
            subject.techniques.emplace_back(technique, textWith(choice));
        subject.empty = textWith(none);
    }
    auto run = BudgetRun::create(loader_, std::move(subject));
    if (!run)
        return run.status();
    budget_ = std::move(*run);
    budgetRevision_ = session.shownRevision();
    return {};
}

/// Measures one piece a frame.
void EmbeddedEditor::updateBudget()
{
    BudgetState& state = state_->budget;
    if (std::exchange(state.isAsked, false)) {
        state.report = {}; // its textures go with the run
        const base::Status status = startBudget();
        state.failure = status.message();
        state.isRunning = status.ok();
    }
    if (std::exchange(state.isStopped, false))
        state.isRunning = false;
    if (!budget_)
        return;
    state.isOld = budgetRevision_ != session_->shownRevision();
    if (!state.isRunning)
        return;
    const base::Status status = budget_->step();
    state.failure = status.message();
    state.progress = budget_->progress();
    state.report = budget_->report();
    state.isRunning = !budget_->isDone();
}

base::Status EmbeddedEditor::startRender()
{
    const Session& session = *session_;
    auto run = RenderRun::create(loader_, {state_->render.request, session.shownText(), session.name(),
                                           session.document.kind(), session.camera, session.exposureEv100,
                                           session.playback.time(), session.playback.end, session.motion(),
                                           session.followsCamera && session.hasCameraKeys()});
    if (run)
        render_ = std::move(*run);
    return run.status();
}

/// Writes one frame a frame.
void EmbeddedEditor::updateRender()
{
    RenderState& state = state_->render;
    if (std::exchange(state.isAsked, false) && !render_)
        session_->run(startRender());
    if (std::exchange(state.isStopped, false) && render_) {
        render_.reset();
        session_->message = "Rendering was cancelled.";
    }
    state.isRunning = render_ != nullptr;
    if (!render_)
        return;
    const base::Status status = render_->step();
    state.progress = render_->progress();
    if (!render_->isDone())
        return;
    session_->run(status);
    if (status.ok())
        session_->message = "Wrote " + state.request.file;
    render_.reset();
    state.isRunning = false;
}

void EmbeddedEditor::answerWhy()
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

base::Status EmbeddedEditor::link(const std::string& address)
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
void EmbeddedEditor::updateLink(double seconds)
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

void EmbeddedEditor::answerRequests()
{
    if (state_->asksWhy)
        answerWhy();
    if (std::exchange(state_->asksCamera, false) && preview_->hasScene())
        takeCamera();
}

void EmbeddedEditor::draw(double seconds, ImVec2 low, ImVec2 size)
{
    session_->update(seconds);
    updateLink(seconds); // before the picture, which takes longer
    updateError();       // before the picture, which it draws over
    updateBudget();
    updateRender();
    updatePicture();
    updateBefore();
    drawEditor(*state_, low, size);
    answerRequests();
}

} // namespace fx::editor
