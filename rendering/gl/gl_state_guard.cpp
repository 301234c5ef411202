#include "rendering/gl/gl_state_guard.h"

#include "rendering/gl/gl_device.h"

namespace fx::render {

std::span<const char* const> touchedState()
{
    static const auto kNames = [] {
        std::array<const char*, kGlTouchedStates> names{};
        for (size_t i = 0; i < names.size(); ++i)
            names[i] = glTouchedStates()[i].name;
        return names;
    }();
    return kNames;
}

GlStateGuard::GlStateGuard(GlDevice& device, bool active) : device_(active ? &device : nullptr)
{
    if (!active)
        return;
    size_t slot = 0;
    for (const GlTouchedState& state : glTouchedStates()) {
        for (uint32_t index = 0; index < state.count; ++index)
            state.save(device.gl, state.what, index, saved_[slot++]);
    }
}

GlStateGuard::~GlStateGuard()
{
    if (!device_)
        return;
    const auto states = glTouchedStates();
    size_t slot = saved_.size();
    for (size_t i = states.size(); i-- > 0;) {
        for (uint32_t index = states[i].count; index-- > 0;)
            states[i].restore(device_->gl, states[i].what, index, saved_[--slot]);
    }
    (void)device_->takeError(
        "restoring the host's state"); // a name that was bound though deleted cannot come back
}

} // namespace fx::render
