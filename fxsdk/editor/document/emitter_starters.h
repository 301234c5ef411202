/// @file emitter_starters.h
/// Emitters to begin with, each of which is seen at once.
#pragma once

#include "fxsdk/editor/document/json_writer.h"

#include <span>
#include <string>

namespace fx::editor {

struct EmitterStarter
{
    const char* name;        ///< also of the emitter
    const char* description; ///< for people
    const char* members;     ///< JSON of the emitter without its name
};

/// Flame, smoke, steam, sparks and dust, which look right alone.
std::span<const EmitterStarter> emitterStarters();

/// The emitter of a starter, with a name that no emitter of the preset has.
Json starterEmitter(const EmitterStarter& starter, const Json& preset);

} // namespace fx::editor
