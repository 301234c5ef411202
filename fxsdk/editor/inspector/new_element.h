/// @file new_element.h
/// Elements that are added to an array of a document, valid from the start.
#pragma once

#include "foundation/result/status.h"
#include "fxsdk/editor/inspector/member.h"

namespace fx::editor {

/// A new last element. Where elements have a time it is 1 s after the last one, which it otherwise repeats;
/// an event gives birth in another emitter, or tells the host where there is none.
/// @param array a member of the kind Array
/// @return InvalidArgument if the element needs something that the document does not have, with the remedy
base::Result<Json> newElement(const Document& document, const Member& array);

/// Adds a new last element as one edit; where the array needs more of them, as many as it needs.
/// @return as newElement(), also if the array has no room
base::Status addElement(Document& io, const Member& array);

} // namespace fx::editor
