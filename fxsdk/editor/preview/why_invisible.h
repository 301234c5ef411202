/// @file why_invisible.h
/// Reasons why a preset shows nothing, or less than expected.
#pragma once

#include "fxsdk/editor/document/document.h"
#include "fxsdk/editor/document/solo_mute.h"

#include <cstdint>
#include <string>
#include <vector>

namespace fx::editor {

/// Returns one sentence per reason, with its JSON pointer and a remedy; at least one.
/// @param time [s] local time of the picture @param particles alive at that time
std::vector<std::string> whyInvisible(const Document& document, const SoloMute& choice, double time,
                                      uint32_t particles);

} // namespace fx::editor
