#include "fxsdk/editor/session/session.h"

#include "fxsdk/editor/document/starter.h"
#include "fxsdk/editor/session/time_edits.h"

#include <chrono>
#include <cmath>
#include <utility>

namespace fx::editor {

namespace {

/// Length of the timeline [s] of a preset: its duration without its prewarm, otherwise twice the time of its
/// preview.
double timelineOf(const Json& preset)
{
    const double duration =
        preset.value("duration", Json(0.0)).is_number() ? preset.value("duration", 0.0) : 0.0;
    const double prewarm =
        preset.value("prewarm", Json(0.0)).is_number() ? preset.value("prewarm", 0.0) : 0.0;
    if (duration > prewarm)
        return duration - std::max(prewarm, 0.0);
    const Json::json_pointer still("/preview/time");
    const double time =
        preset.contains(still) && preset[still].is_number() ? preset[still].get<double>() : 0.0;
    return time > 2.5 ? 2.0 * time : 5.0;
}

constexpr const char* kTime = "/preview/time";

const char* cameraOf(DocumentKind kind)
{
    return kind == DocumentKind::Scene ? "/camera" : "/preview/camera";
}

/// The value at a pointer; null if there is none.
Json partOf(const Json& document, const char* pointer)
{
    const Json::json_pointer at(pointer);
    return document.contains(at) ? document.at(at) : Json();
}

bool hasKeys(const Json& camera)
{
    const auto keys = camera.is_object() ? camera.find("keys") : camera.end();
    return keys != camera.end() && keys->is_array() && !keys->empty();
}

} // namespace

base::Result<std::unique_ptr<Session>> Session::open(const std::string& input, std::filesystem::path recovery)
{
    auto document = Document::open(input);
    if (!document)
        return document.status();
    return std::unique_ptr<Session>(new Session(std::move(*document), input, std::move(recovery)));
}

base::Result<std::unique_ptr<Session>> Session::begin(const std::string& path, std::filesystem::path recovery)
{
    auto document = newDocument(path);
    if (!document)
        return document.status();
    std::unique_ptr<Session> session(new Session(std::move(*document), path, std::move(recovery)));
    session->message = "A new file: Save writes it.";
    return session;
}

Session::Session(Document opened, std::string name, std::filesystem::path recovery)
    : document(std::move(opened)), name_(std::move(name)), recoveryFolder_(std::move(recovery)),
      autosave_(name_, recoveryFolder_), watch_(document.path()), recovery_(autosave_.recoverable())
{
    playback.end = timelineOf(document.json());
    playback.scrub(0.2 * playback.end);
    statedTime_ = partOf(document.json(), kTime);
    statedCamera_ = partOf(document.json(), cameraOf(document.kind()));
    if (statedTime_.is_number())
        playback.scrub(statedTime_.get<double>());
    if (autosave_.isOpenElsewhere())
        message = "Another running editor has unsaved changes of this file.";
    if (recovery_ && *recovery_ == document.text())
        discardRecovery();
    if (const auto elements = soloElements(document.json(), document.schema()); !elements.empty())
        selection = elements.front();
}

void Session::setSolo(const std::string& element, bool isSolo)
{
    soloMute_.setSolo(element, isSolo);
    ++choice_;
}

void Session::setMuted(const std::string& element, bool isMuted)
{
    soloMute_.setMuted(element, isMuted);
    ++choice_;
}

const Json& Session::stateBefore() const
{
    const Json* const kept = snapshots.state(0);
    return kept ? *kept : document.savedJson();
}

void Session::setStage(StageChoice choice)
{
    if (choice == stage_)
        return;
    stage_ = std::move(choice);
    ++choice_;
}

void Session::setMotion(const MotionChoice& motion)
{
    if (motion == motion_)
        return;
    motion_ = motion;
    ++choice_;
}

void Session::keepStage()
{
    Json kept = onStage(document.json(), document.kind(), stage_);
    const bool isScene = document.kind() == DocumentKind::Scene;
    if (exposureEv100) {
        Json& holder = isScene ? kept : kept["preview"];
        if (!holder.is_object()) // absent, or what the file states is no preview
            holder = Json::object();
        holder["exposureEv100"] = *exposureEv100;
    }
    if (kept == document.json()) {
        message = "Stage and exposure are those of the document.";
        return;
    }
    if (isScene)
        document.replace(std::move(kept), "keep the stage");
    else
        run(document.set("/preview", kept["preview"]));
    setStage({});
    exposureEv100.reset();
}

bool Session::followPreview()
{
    Json time = partOf(document.json(), kTime);
    if (time != statedTime_ && time.is_number()) {
        if (time.get<double>() > playback.end)
            playback.end = timelineOf(document.json());
        playback.scrub(time.get<double>());
    }
    statedTime_ = std::move(time);
    Json stated = partOf(document.json(), cameraOf(document.kind()));
    const bool hasChanged = stated != statedCamera_;
    const bool hadKeys = hasKeys(statedCamera_);
    statedCamera_ = std::move(stated);
    return hasChanged && (followsCamera || !(hadKeys || hasKeys(statedCamera_)));
}

bool Session::hasCameraKeys() const
{
    return hasKeys(partOf(document.json(), cameraOf(document.kind())));
}

void Session::keepCamera()
{
    const char* const pointer = cameraOf(document.kind());
    Json kept = partOf(document.json(), pointer);
    if (!kept.is_object()) // absent, or what the file states is no camera
        kept = Json::object();
    kept.erase("keys");
    kept.erase("orthographicHeight"); // the picture is in perspective
    kept["position"] = placeOf(camera.position());
    kept["target"] = placeOf(camera.target());
    kept["fovYDegrees"] = std::round(100.0 * double(camera.fovYDegrees)) / 100.0;
    run(document.set(pointer, std::move(kept)));
}

void Session::run(const base::Status& status)
{
    message = status.ok() ? std::string() : status.message();
    mendSelection();
}

void Session::mendSelection()
{
    const auto exists = [&](const std::string& pointer) {
        return document.json().contains(Json::json_pointer(pointer));
    };
    while (!selection.empty() && !exists(selection))
        selection = Json::json_pointer(selection).parent_pointer().to_string();
    if (!curve.empty() && !exists(curve))
        curve.clear();
}

void Session::undo()
{
    message = document.undo() ? std::string() : "There is nothing to undo.";
    mendSelection();
}

void Session::redo()
{
    message = document.redo() ? std::string() : "There is nothing to redo.";
    mendSelection();
}

void Session::save(bool force)
{
    run(document.save(force));
    if (!message.empty())
        return;
    conflict_.reset();
    watch_ = FileWatch(document.path());
    message = "Saved " + document.path();
}

void Session::saveAs(const std::string& path)
{
    run(document.saveAs(path));
    if (!message.empty())
        return;
    autosave_.discard();
    name_ = path;
    autosave_ = Autosave(path, recoveryFolder_);
    watch_ = FileWatch(path);
    conflict_.reset();
    message = "Saved " + path;
}

std::string Session::textOf(const Json& state) const
{
    const bool isAll = !soloMute_.isActive() || document.kind() == DocumentKind::Scene;
    if (isAll && stage_ == StageChoice() && &state == &document.json())
        return document.text();
    return writeJson(
        onStage(isAll ? state : soloMute_.shown(state, document.schema()), document.kind(), stage_));
}

std::string Session::shownText() const
{
    return textOf(document.json());
}

const std::vector<DocumentFinding>& Session::findings()
{
    if (findingsRevision_ != document.revision()) {
        findings_ = findingsOf(document);
        findingsRevision_ = document.revision();
    }
    return findings_;
}

const std::map<std::string, std::string>& Session::unusedMembers()
{
    if (unusedRevision_ != document.revision() || unusedSelection_ != selection) {
        unused_ = unusedMembersOf(document, selection);
        unusedRevision_ = document.revision();
        unusedSelection_ = selection;
    }
    return unused_;
}

void Session::takeTheirs()
{
    if (!conflict_)
        return;
    run(document.reload(*conflict_));
    conflict_.reset();
}

void Session::keepMine()
{
    if (!conflict_)
        return;
    run(document.acceptFileText(*conflict_));
    if (message.empty())
        conflict_.reset();
}

void Session::recover()
{
    if (!recovery_)
        return;
    const Json recovered = Json::parse(*recovery_, nullptr, false);
    if (recovered.is_object())
        document.replace(recovered, "recover");
    else
        message = "The recovered text is not JSON.";
    recovery_.reset();
    mendSelection();
}

void Session::discardRecovery()
{
    recovery_.reset();
    autosave_.discard();
}

/// A document without edits follows its file at once.
void Session::watchFile()
{
    auto text = watch_.changedText(document.savedText());
    if (!text)
        return;
    if (document.isDirty()) {
        conflict_ = std::move(text);
        return;
    }
    run(document.reload(*text));
    if (message.empty())
        message = "The file has changed outside of the editor and was read again.";
}

void Session::update(double seconds)
{
    watchFile();
    if (!recovery_)
        if (const base::Status status = autosave_.update(document); !status)
            message = status.message();
    playback.advance(seconds);
}

void Session::close()
{
    if (!recovery_)
        autosave_.discard();
}

std::string Session::keepForRecovery()
{
    if (!document.isDirty() || recovery_) // what is offered belongs to an earlier session
        return {};
    const base::Status status = autosave_.update(document, std::chrono::milliseconds(0));
    return status.ok() ? autosave_.file().string() : std::string();
}

} // namespace fx::editor
