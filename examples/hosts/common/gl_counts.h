/// @file gl_counts.h
/// Counts the calls of OpenGL that a library makes, by functions of its own between the library and OpenGL.
///
/// Threads: the GL thread. There is one counter, since functions of OpenGL have no argument for another.
#pragma once

#include "fxsdk/fx_context.h"

#include <cstdint>
#include <string>
#include <vector>

namespace host {

struct GlCounts
{
    uint64_t calls = 0;
    uint64_t queries = 0; ///< calls of glGet... and glIs...
};

/// A loader whose functions count and then call those of `real`, which must outlive all calls.
FxGlLoader countedLoader(const FxGlLoader& real);

/// Calls since the last reset.
GlCounts counts();
void resetCounts();

/// Functions that were handed out without counting, because the build does not know their type.
const std::vector<std::string>& uncountedFunctions();

} // namespace host
