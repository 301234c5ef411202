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

/// When a state is saved.
enum class GlStateGroup : uint8_t
{
    Frame, ///< when a frame begins
    /// When a frame begins. Drawing only turns these switches off, so that a switch that is off needs no
    /// further call.
    Off,
    // The others are saved before the frame first changes the state at one index.
    TextureUnit,
    ImageUnit,
    UniformBinding,
    StorageBinding,
    DrawBuffer, ///< blending
    ColorMask,  ///< of a draw buffer
};

struct GlTouchedState
{
    const char* name; ///< name of the state, as shown to users
    GLenum what;      ///< argument of `save` and `restore`
    /// Number of indices (of draw buffers, units or bindings); the state is saved at indices 0 to count - 1.
    uint32_t count;
    void (*save)(const GlFunctions& gl, GLenum what, uint32_t index, GlSavedState& outSaved);
    void (*restore)(const GlFunctions& gl, GLenum what, uint32_t index, const GlSavedState& saved);
    GlStateGroup group = GlStateGroup::Frame;
};

/// Returns the table. States are saved in the order of the table and restored in reverse order. A state that
/// changes while another state is saved or restored comes first in the table.
std::span<const GlTouchedState> glTouchedStates();

constexpr uint32_t kGlSavedStates = 101; ///< sum of the counts of all states
constexpr uint32_t kGlTouchedStates = 40;

} // namespace fx::render
