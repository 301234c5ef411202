/// @file document.h
/// A preset or scene that is edited: the JSON of a file, and commands that change it and can be undone.
///
/// Members that the schema does not know are kept. Threads: one at a time.
#pragma once

#include "foundation/result/status.h"
#include "fxsdk/editor/document/edit_history.h"
#include "fxsdk/editor/document/schema_tree.h"

#include <cstdint>
#include <string>

namespace fx::editor {

class Document
{
public:
    /// Reads a file, or a preset of the library (`library:NAME`), which is then without a file.
    /// @return NotFound, TooLarge, Io, or Parse and Schema for text that is not JSON. A document that
    /// violates its schema is opened
    static base::Result<Document> open(const std::string& path);
    /// @param path file to which save() writes; it need not exist. Scenes end in ".scene.json"
    static base::Result<Document> fromText(const std::string& text, const std::string& path);

    const Json& json() const { return json_; }
    /// The bytes that save() writes. An unchanged document has the bytes of its file.
    std::string text() const;
    const std::string& path() const { return path_; }
    DocumentKind kind() const { return kind_; }
    const Json& schema() const { return schemaOf(kind_); }
    bool isDirty() const { return json_ != savedJson_; }
    /// Increases with each change, undo and redo included.
    uint64_t revision() const { return revision_; }

    /// Sets a member or element. Absent members are added at their place in the schema, with the objects
    /// around them.
    /// @param gesture not 0: joins the edit with the last one of the same pointer and number
    /// @return InvalidArgument if `pointer` leads through a value that has no members, or past an array
    base::Status set(const std::string& pointer, Json value, uint64_t gesture = 0);
    /// Removes a member or element. @return NotFound
    base::Status erase(const std::string& pointer);
    /// Inserts an element before the element `index`. An absent array is created.
    /// @return InvalidArgument if `array` is no array, or `index` above its size
    base::Status insert(const std::string& array, size_t index, Json value);
    /// Moves an element so that it has the index `to` afterwards. @return InvalidArgument
    base::Status move(const std::string& array, size_t from, size_t to);
    /// Inserts a copy of an element behind it; a member "name" gets a number that no other element has.
    /// @return InvalidArgument
    base::Status duplicate(const std::string& array, size_t index);
    /// Replaces the whole document, as one edit.
    void replace(Json document, const std::string& label);

    bool undo();
    bool redo();
    const EditHistory& history() const { return history_; }

    /// Writes the file atomically. @param force true: also when the file has changed outside of the editor
    /// @return Io, or InvalidArgument if the file has changed outside, or the document is without a file
    base::Status save(bool force = false);
    /// Writes another file, which becomes the file of the document.
    base::Status saveAs(const std::string& path);

    /// Text of the file when it was last read or written by the editor.
    const std::string& savedText() const { return savedText_; }
    /// State of the file when it was last read or written by the editor.
    const Json& savedJson() const { return savedJson_; }
    /// Takes over the text of the file after a change outside. This is an edit that can be undone.
    /// @return Parse or Schema; the document is unchanged
    base::Status reload(const std::string& text);
    /// States that the file holds `text` now, without a change of the document. @return as reload()
    base::Status acceptFileText(const std::string& text);

private:
    Document() = default;
    void apply(const std::string& label, const std::string& pointer, Json after, uint64_t gesture = 0);
    base::Status insertMember(const Json::json_pointer& pointer, Json value, uint64_t gesture = 0);
    std::string addedBy(uint64_t gesture, const std::string& pointer) const;
    base::Status checkElement(const std::string& array, size_t index) const;
    base::Status write(const std::string& path);

    Json json_;
    Json savedJson_;
    std::string savedText_;
    std::string path_;
    DocumentKind kind_ = DocumentKind::Preset;
    EditHistory history_;
    uint64_t revision_ = 1;
};

} // namespace fx::editor
