/// @file shader_library.h
/// The GLSL sources of every program, compiled into the library as text.
#pragma once

#include "foundation/result/embedded_text.h"

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace fx::shaders {

/// Returns the complete GLSL of the entry point `name`, such as "blobs/media.frag.glsl". The result consists
/// of the version line, `defines`, and the file, in which each include is expanded once. Defines such as
/// "FX_FORM=2 FX_LAYERS=1" are separated by blanks or line breaks.
/// @return no value if `name` or one of its includes does not exist
std::optional<std::string> assemble(std::string_view name, std::string_view defines);

/// Text of one file, without expanding includes; empty if the file does not exist.
std::string_view text(std::string_view name);

/// The embedded texts of each folder. CMake generates the definition of this function from its list of
/// folders.
std::span<const std::span<const base::EmbeddedText>> folders();

} // namespace fx::shaders
