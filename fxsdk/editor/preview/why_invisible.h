/// @file why_invisible.h
/// Reasons why a preset shows nothing, or less than expected.
#pragma once

#include "fxsdk/editor/document/document.h"
#include "fxsdk/editor/document/solo_mute.h"

#include <string>
#include <vector>

namespace fx::editor {

/// Reasons that the text of a document gives: one sentence each, with its JSON pointer and a remedy.
/// Preview::causes() knows those of the picture.
/// @param time [s] local time of the picture
std::vector<std::string> whyInvisible(const Document& document, const SoloMute& choice, double time);

} // namespace fx::editor
