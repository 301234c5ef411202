/// @file session.h
/// Everything that the editor knows about one document: what is edited, selected, shown and played. Panels
/// show a session and change it; nothing here draws.
#pragma once

#include "fxsdk/editor/document/autosave.h"
#include "fxsdk/editor/document/document_findings.h"
#include "fxsdk/editor/document/file_watch.h"
#include "fxsdk/editor/document/snapshots.h"
#include "fxsdk/editor/document/solo_mute.h"
#include "fxsdk/editor/session/motion_choice.h"
#include "fxsdk/editor/session/orbit_camera.h"
#include "fxsdk/editor/session/overlays.h"
#include "fxsdk/editor/session/playback.h"
#include "fxsdk/editor/session/stage_choice.h"

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace fx::editor {

/// Two pictures side by side: a state of before on the left, the present on the right.
struct Comparison
{
    bool isShown = false;
    double split = 0.5; ///< [0, 1] place of the line between them
};

class Session
{
public:
    /// Opens a preset, a scene, or a preset of the library.
    /// @param recovery folder of recovery files
    static base::Result<std::unique_ptr<Session>> open(const std::string& input,
                                                       std::filesystem::path recovery = recoveryFolder());
    /// Begins a preset or a scene (see starter.h). Its file is written by save().
    static base::Result<std::unique_ptr<Session>> begin(const std::string& path,
                                                        std::filesystem::path recovery = recoveryFolder());
    ~Session() = default;
    Session(const Session&) = delete;
    Session& operator=(const Session&) = delete;

    Document document;
    Snapshots snapshots;
    Playback playback;
    OrbitCamera camera;
    OverlayChoice overlays;
    bool followsCamera = false; ///< the picture looks through the camera of the document at each time
    Comparison comparison;
    std::optional<float> exposureEv100; ///< [EV100] empty: that of the preview
    std::string selection;              ///< JSON pointer of the object in the inspector; "" is the document
    std::string curve;                  ///< JSON pointer of the curve that is edited; empty: none
    std::string message;                ///< result of the last command, for people

    const SoloMute& soloMute() const { return soloMute_; }
    void setSolo(const std::string& element, bool isSolo);
    void setMuted(const std::string& element, bool isMuted);

    /// The state of before that is compared: A where it is kept, otherwise the saved one.
    const Json& stateBefore() const;
    /// Changes with solo, mute, stage and motion, which both pictures have.
    uint64_t choiceRevision() const { return choice_; }

    const StageChoice& stage() const { return stage_; }
    void setStage(StageChoice choice);
    /// Writes stage and exposure of the picture into the document, as one edit.
    void keepStage();

    /// Motion of the picture; at first that of the document.
    const MotionChoice& motion() const { return motion_; }
    void setMotion(const MotionChoice& motion);
    /// Takes over the time that the document states for its picture, where it has changed since the last
    /// call.
    /// @return whether the view is to become that of the document's camera: the camera has changed, and had
    ///         and has no keys or is followed. A key that is added, moved or removed leaves the view, from
    ///         which further keys are taken
    bool followPreview();
    /// Whether the camera of the document moves through keys.
    bool hasCameraKeys() const;
    /// Writes the camera of the picture into the document, as one edit; keys of a camera path go.
    void keepCamera();

    /// Runs a command, keeps its failure as message(), and mends the selection.
    void run(const base::Status& status);
    void undo();
    void redo();
    void save(bool force = false);
    void saveAs(const std::string& path);

    /// Name of the document for people and messages.
    const std::string& name() const { return name_; }
    /// Changes with what is to be shown: document, solo, mute, stage and motion.
    uint64_t shownRevision() const { return document.revision() + choice_; }
    /// Text to be shown instead of the document.
    std::string shownText() const;

    /// Text that shows another state of the document under the same choices.
    std::string textOf(const Json& state) const;

    /// Errors and warnings of the document; computed when the document has changed.
    const std::vector<DocumentFinding>& findings();

    /// Absent members of the selection that would have no effect, with the reason; computed when document or
    /// selection have changed.
    const std::map<std::string, std::string>& unusedMembers();

    /// Text of the file that has changed outside while the document is edited; empty: no conflict.
    const std::optional<std::string>& conflict() const { return conflict_; }
    void takeTheirs(); ///< resolves a conflict by the text of the file
    void keepMine();   ///< resolves a conflict: the next save overwrites the file

    /// Text that a crash has left; empty: none.
    const std::optional<std::string>& recovery() const { return recovery_; }
    void recover();         ///< takes the text over, as an edit that can be undone
    void discardRecovery(); ///< deletes the text

    /// Looks at the file, writes the recovery file, advances the timeline. Call it once a frame.
    /// @param seconds [s] real time since the last call
    void update(double seconds);
    /// Ends the session: no recovery file of it is left. One that was offered and not answered stays.
    void close();
    /// Writes the recovery file now, for an end without saving. @return its path; empty: nothing was unsaved,
    /// or the file could not be written
    std::string keepForRecovery();

private:
    Session(Document opened, std::string name, std::filesystem::path recovery);
    void mendSelection();
    void watchFile();

    std::string name_;
    std::filesystem::path recoveryFolder_;
    SoloMute soloMute_;
    StageChoice stage_;
    MotionChoice motion_;
    Json statedTime_;     ///< of the preview, at the last followPreview(); null: none
    Json statedCamera_;   ///< of the document, likewise
    uint64_t choice_ = 0; ///< changes of solo, mute, stage and motion
    Autosave autosave_;
    FileWatch watch_;
    std::optional<std::string> conflict_;
    std::optional<std::string> recovery_;
    std::vector<DocumentFinding> findings_;
    uint64_t findingsRevision_ = 0;
    std::map<std::string, std::string> unused_;
    std::string unusedSelection_; ///< that unused_ belongs to
    uint64_t unusedRevision_ = 0;
};

} // namespace fx::editor
