#include "fxsdk/editor/document/edit_history.h"

#include <utility>

namespace fx::editor {

void EditHistory::apply(Json& io, Edit edit)
{
    io[Json::json_pointer(edit.pointer)] = edit.after;
    edits_.resize(done_);
    if (done_ > 0 && edit.gesture != 0) {
        Edit& last = edits_.back();
        if (last.gesture == edit.gesture && last.pointer == edit.pointer) {
            last.after = std::move(edit.after);
            return;
        }
    }
    edits_.push_back(std::move(edit));
    ++done_;
}

bool EditHistory::undo(Json& io)
{
    if (!canUndo())
        return false;
    const Edit& edit = edits_[--done_];
    io[Json::json_pointer(edit.pointer)] = edit.before;
    return true;
}

bool EditHistory::redo(Json& io)
{
    if (!canRedo())
        return false;
    const Edit& edit = edits_[done_++];
    io[Json::json_pointer(edit.pointer)] = edit.after;
    return true;
}

void EditHistory::clear()
{
    edits_.clear();
    done_ = 0;
}

} // namespace fx::editor
