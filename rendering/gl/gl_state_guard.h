/// @file gl_state_guard.h
/// Leaves the host's OpenGL state as it was: saves everything that GlBackend touches, restores it when
/// destroyed.
///
/// One table (gl_touched_state.cpp) drives saving, restoring and the published list, so they cannot disagree.
/// An object that the host had deleted while it was bound cannot be bound again. No GL error is left behind.
/// Threads: [GL thread].
#pragma once

#include "rendering/gl/gl_touched_state.h"

#include <array>
#include <cstdint>
#include <span>

namespace fx::render {

class GlDevice;

/// States that drawing changes, as text: one line per state, such as "GL_BLEND (draw buffers 0 to 7)".
std::span<const char* const> touchedState();

class GlStateGuard
{
public:
    /// `active` false makes a guard that does nothing (the host owns the state).
    explicit GlStateGuard(GlDevice& device, bool active = true);
    ~GlStateGuard();
    GlStateGuard(const GlStateGuard&) = delete;
    GlStateGuard& operator=(const GlStateGuard&) = delete;

private:
    GlDevice* device_; ///< null when inactive
    std::array<GlSavedState, kGlSavedStates> saved_;
};

} // namespace fx::render
