/// @file shader_library.h
/// The GLSL sources of every program, compiled into the library as text.
#pragma once

#include "foundation/result/embedded_text.h"

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace fx::shaders {

/// The complete GLSL of the entry point `name` ("blobs/media.frag.glsl"): the version line, `defines`
/// ("FX_FORM=2 FX_LAYERS=1", separated by blanks or line breaks), and the file with its includes expanded
/// once each.
/// @return nothing when `name` or one of its includes does not exist
std::optional<std::string> assemble(std::string_view name, std::string_view defines);

/// Text of one file, without expanding includes. Empty when the file does not exist.
std::string_view text(std::string_view name);

/// The embedded texts of each folder. CMake generates the definition from its list of folders.
std::span<const std::span<const base::EmbeddedText>> folders();

} // namespace fx::shaders
