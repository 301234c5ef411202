/// @file gl_touched_state.h
/// The table of GL state that drawing touches, with how to read and how to write each. Used by GlStateGuard.
#pragma once

#include "rendering/gl/gl_functions.h"

#include <cstdint>
#include <span>

namespace fx::render {

/// Values of one entry at one index; which members are used is known to the entry's functions.
struct GlSavedState
{
    GLint64 integers[6];
    GLdouble reals[4];
};

struct GlTouchedState
{
    const char* name; ///< for people
    GLenum what;      ///< for the functions
    uint32_t count;   ///< indices 0 to count - 1: draw buffers, units, bindings
    void (*save)(const GlFunctions& gl, GLenum what, uint32_t index, GlSavedState& outSaved);
    void (*restore)(const GlFunctions& gl, GLenum what, uint32_t index, const GlSavedState& saved);
};

/// States are saved in this order and restored in reverse. States that are changed while other states are
/// saved or restored are at the beginning of the table.
std::span<const GlTouchedState> glTouchedStates();

constexpr uint32_t kGlSavedStates = 140; ///< sum of the counts
constexpr uint32_t kGlTouchedStates = 43;

} // namespace fx::render
