/// @file document_findings.h
/// Errors and warnings about a document while it is edited, with remedies that can be applied.
#pragma once

#include "fxsdk/editor/document/document.h"
#include "fxsdk/presets/diagnostic.h"

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace fx::editor {

/// A change that resolves a finding.
struct Remedy
{
    std::string label; ///< for a button, such as "set to 1"
    std::string pointer;
    std::optional<Json> value; ///< empty: the member is removed
};

struct DocumentFinding
{
    preset::Diagnostic diagnostic; ///< file, line and column are those of Document::text()
    std::optional<Remedy> remedy;
};

/// Validates the document as hosts would load it. Files that it names are searched in its folder.
std::vector<DocumentFinding> findingsOf(const Document& document);

/// Absent members of the object at `pointer` and of the objects in it that would have no effect, such as
/// those of media in an emitter of sprites: pointers with the reason. Empty while the document has errors.
std::map<std::string, std::string> unusedMembersOf(const Document& document, const std::string& pointer);

/// Proposes a remedy for the value at `pointer`: the nearest value of its range or of its enumeration, or its
/// removal if the schema does not know it.
std::optional<Remedy> remedyFor(const Document& document, const std::string& pointer);

/// Applies a remedy as one edit.
base::Status applyRemedy(Document& io, const Remedy& remedy);

} // namespace fx::editor
