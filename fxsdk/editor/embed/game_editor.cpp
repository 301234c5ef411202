#include "fxsdk/editor/embed/game_editor.h"

#include "fxsdk/editor/embed/embedded_editor.h"

#include <utility>

namespace fx::editor {

std::unique_ptr<GameEditor> GameEditor::open(const std::string& file, const std::string& recovery,
                                             FindFunction find, void* user, std::string& outError)
{
    auto session = Session::open(file, recovery.empty() ? recoveryFolder() : std::filesystem::path(recovery));
    if (!session) {
        outError = session.status().message();
        return nullptr;
    }
    auto editor = EmbeddedEditor::create(std::move(*session), {user, find});
    if (!editor) {
        outError = editor.status().message();
        return nullptr;
    }
    std::unique_ptr<GameEditor> result(new GameEditor);
    result->editor_ = std::move(*editor);
    return result;
}

GameEditor::~GameEditor() = default;

void GameEditor::draw(double seconds, float x, float y, float width, float height)
{
    editor_->draw(seconds, {x, y}, {width, height});
}

void GameEditor::scrub(double seconds)
{
    editor_->session().playback.scrub(seconds);
}

std::string GameEditor::link(const std::string& address)
{
    const base::Status status = editor_->link(address);
    return status.ok() ? std::string() : status.message();
}

std::string GameEditor::save()
{
    const base::Status status = editor_->session().document.save();
    return status.ok() ? std::string() : status.message();
}

bool GameEditor::isDirty() const
{
    return editor_->session().document.isDirty();
}

std::string GameEditor::text() const
{
    return editor_->session().document.text();
}

uint32_t GameEditor::particles() const
{
    return editor_->state().picture.particles;
}

void GameEditor::close()
{
    editor_->session().close();
}

} // namespace fx::editor
