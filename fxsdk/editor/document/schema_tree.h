/// @file schema_tree.h
/// Finds the schema of a value of a preset or scene, and the canonical order of members.
#pragma once

#include "fxsdk/editor/document/json_writer.h"

#include <cstddef>
#include <string>

namespace fx::editor {

enum class DocumentKind
{
    Preset, ///< *.fx.json
    Scene   ///< *.scene.json
};

/// Schema of documents of a kind. The reference is valid for the life of the process.
const Json& schemaOf(DocumentKind kind);

/// Returns `schema` with its alternative for `value` decided; `schema` itself if it has no alternatives.
const Json& decided(const Json& schema, const Json& value);

/// Returns the schema of the value that `document` has at `pointer`, or would have there; null if the schema
/// has no such member.
const Json* schemaAt(const Json& schema, const Json& document, const Json::json_pointer& pointer);

/// Index at which a new member belongs in `object`: before the first member that follows it in the schema.
/// Members that the schema does not know do not move.
/// @param schema schema of the object, or null for the end
size_t canonicalIndex(const Json& object, const std::string& key, const Json* schema);

} // namespace fx::editor
