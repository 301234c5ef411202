/// @file gl_state_guard.h
/// Preserves the host's OpenGL state: saves all states that GlBackend changes, and restores them in its
/// destructor. States that each frame changes are saved by the constructor. States that are many and of which
/// a frame changes few, as of texture units, are saved before their first change.
///
/// Saving, restoring and touchedState() use one table (gl_touched_state.cpp), so they always agree. An
/// object that the host deleted while it was bound cannot be bound again. After the destructor, no GL error
/// is pending. Threads: [GL thread].
#pragma once

#include "rendering/gl/gl_touched_state.h"

#include <array>
#include <bitset>
#include <cstdint>
#include <span>

namespace fx::render {

class GlDevice;

/// Names of the GL states that drawing changes, one per line, such as "GL_BLEND (draw buffers 0 to 7)".
std::span<const char* const> touchedState();

class GlStateGuard
{
public:
    /// While an active guard exists, it is GlDevice::guard.
    /// @param active false: the guard does nothing, because the host sets its states itself
    explicit GlStateGuard(GlDevice& device, bool active = true);
    ~GlStateGuard();
    GlStateGuard(const GlStateGuard&) = delete;
    GlStateGuard& operator=(const GlStateGuard&) = delete;

    /// Saves the states of a group at one index, if they are not saved yet. To be called before they are
    /// changed.
    void touch(GlStateGroup group, uint32_t index);
    /// Saves all states, for code that changes them by calls of its own.
    void touchAll();
    /// True if this switch of the group Off is known to be off.
    bool isOff(GLenum what) const;

private:
    void save(size_t state, uint32_t index);

    GlDevice* device_; ///< null if the guard is not active
    GlStateGuard* outer_ = nullptr;
    bool restoresAll_ = false;
    std::array<GlSavedState, kGlSavedStates> saved_;
    std::bitset<kGlSavedStates> isSaved_;
};

/// Calls GlStateGuard::touch() of the device's guard, if there is one.
void touchState(GlDevice& device, GlStateGroup group, uint32_t index);

} // namespace fx::render
