/// @file starter.h
/// The text with which a new preset or scene begins.
#pragma once

#include "foundation/result/status.h"
#include "fxsdk/editor/document/document.h"

#include <string>

namespace fx::editor {

/// A new document that is not written yet: a column of smoke, or a scene with a campfire. Its name is that of
/// the file.
/// @param path file to which save() writes: "NAME.fx.json" or "NAME.scene.json"
/// @return InvalidArgument if the file exists or has another extension, NotFound if its folder does not exist
base::Result<Document> newDocument(const std::string& path);

} // namespace fx::editor
