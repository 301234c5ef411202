/// @file parameter_reference.h
/// Documentation of every member of presets and scenes. The documentation is generated from the schemas and
/// therefore agrees with them.
#pragma once

#include <string>

namespace fx::preset {

/// Markdown: a table per object with member, meaning, unit, allowed values, default and cost.
std::string parameterReference();

/// The assembled JSON Schema of presets or scenes as text, for editors.
std::string presetSchemaText();
std::string sceneSchemaText();

} // namespace fx::preset
