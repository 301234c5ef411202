/// @file gl_touched_state.h
/// The table of GL states that drawing changes, with functions that save and restore each state. Used by
/// GlStateGuard.
#pragma once

#include "rendering/gl/gl_functions.h"

#include <cstdint>
#include <span>

namespace fx::render {

/// Saved values of one state at one index. The save and restore functions of a state may use only some
/// members.
struct GlSavedState
{
    GLint64 integers[6];
    GLdouble reals[4];
};

struct GlTouchedState
{
    const char* name; ///< name of the state, as shown to users
    GLenum what;      ///< argument of `save` and `restore`
    /// Number of indices (of draw buffers, units or bindings); the state is saved at indices 0 to count - 1.
    uint32_t count;
    void (*save)(const GlFunctions& gl, GLenum what, uint32_t index, GlSavedState& outSaved);
    void (*restore)(const GlFunctions& gl, GLenum what, uint32_t index, const GlSavedState& saved);
};

/// Returns the table. States are saved in the order of the table and restored in reverse order. A state that
/// changes while another state is saved or restored comes first in the table.
std::span<const GlTouchedState> glTouchedStates();

constexpr uint32_t kGlSavedStates = 140; ///< sum of the counts of all states
constexpr uint32_t kGlTouchedStates = 43;

} // namespace fx::render
