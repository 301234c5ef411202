/// @file edit_history.h
/// Undo and redo without a limit of number.
#pragma once

#include "fxsdk/editor/document/json_writer.h"

#include <cstdint>
#include <string>
#include <vector>

namespace fx::editor {

/// One command: the value at `pointer` before and after it.
struct Edit
{
    std::string label; ///< for people, such as "set /emitters/0/size"
    std::string pointer;
    Json before;
    Json after;
    /// Edits of one pointer with the same number, not 0, become one: the moves of one drag.
    uint64_t gesture = 0;
};

class EditHistory
{
public:
    /// Applies an edit to `io`, and forgets the edits that were undone.
    void apply(Json& io, Edit edit);
    /// @return false if there is nothing to undo
    bool undo(Json& io);
    /// @return false if there is nothing to redo
    bool redo(Json& io);
    void clear();

    bool canUndo() const { return done_ > 0; }
    bool canRedo() const { return done_ < edits_.size(); }
    /// Edits from the oldest to the newest; those from done() on are undone.
    const std::vector<Edit>& edits() const { return edits_; }
    size_t done() const { return done_; }

private:
    std::vector<Edit> edits_;
    size_t done_ = 0;
};

} // namespace fx::editor
