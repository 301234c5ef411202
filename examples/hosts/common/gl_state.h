/// @file gl_state.h
/// Reads the states of the current OpenGL context, to compare them before and after a call.
///
/// Threads: the GL thread.
#pragma once

#include <map>
#include <string>

namespace host {

/// Values by name, such as "GL_BLEND[2]" or "GL_COLOR_WRITEMASK[0].1".
using GlState = std::map<std::string, double>;

/// Reads switches, fixed-function state, bindings of objects, buffers, images, textures and samplers, some
/// hundred values. It changes none of them.
GlState readGlState();

/// Number of values that differ. The names are printed to the error stream.
int printDifferences(const GlState& before, const GlState& after);

} // namespace host
