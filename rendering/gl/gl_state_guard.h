/// @file gl_state_guard.h
/// Preserves the host's OpenGL state: the constructor saves all states that GlBackend changes, and the
/// destructor restores the states.
///
/// Saving, restoring and touchedState() use one table (gl_touched_state.cpp), so they always agree. An
/// object that the host deleted while it was bound cannot be bound again. After the destructor, no GL error
/// is pending. Threads: [GL thread].
#pragma once

#include "rendering/gl/gl_touched_state.h"

#include <array>
#include <cstdint>
#include <span>

namespace fx::render {

class GlDevice;

/// Names of the GL states that drawing changes, one per line, such as "GL_BLEND (draw buffers 0 to 7)".
std::span<const char* const> touchedState();

class GlStateGuard
{
public:
    /// @param active false: the guard does nothing, because the host sets its states itself
    explicit GlStateGuard(GlDevice& device, bool active = true);
    ~GlStateGuard();
    GlStateGuard(const GlStateGuard&) = delete;
    GlStateGuard& operator=(const GlStateGuard&) = delete;

private:
    GlDevice* device_; ///< null if the guard is not active
    std::array<GlSavedState, kGlSavedStates> saved_;
};

} // namespace fx::render
