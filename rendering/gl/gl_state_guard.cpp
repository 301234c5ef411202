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

namespace {

/// Index in saved_ of the first index of each state.
constexpr size_t kNone = ~size_t(0);

const std::array<size_t, kGlTouchedStates>& firstSlots()
{
    static const auto kSlots = [] {
        std::array<size_t, kGlTouchedStates> slots{};
        size_t next = 0;
        for (size_t i = 0; i < slots.size(); ++i) {
            slots[i] = next;
            next += glTouchedStates()[i].count;
        }
        return slots;
    }();
    return kSlots;
}

/// Index of the state that holds a switch of the group Off.
size_t offState(GLenum what)
{
    const auto states = glTouchedStates();
    for (size_t i = 0; i < states.size(); ++i)
        if (states[i].group == GlStateGroup::Off && what >= states[i].what &&
            what < states[i].what + states[i].count)
            return i;
    return kNone;
}

} // namespace

GlStateGuard::GlStateGuard(GlDevice& device, bool active) : device_(active ? &device : nullptr)
{
    if (!active)
        return;
    const auto states = glTouchedStates();
    for (size_t i = 0; i < states.size(); ++i)
        if (states[i].group == GlStateGroup::Frame || states[i].group == GlStateGroup::Off)
            for (uint32_t index = 0; index < states[i].count; ++index)
                save(i, index);
    outer_ = device.guard;
    device.guard = this;
}

void GlStateGuard::save(size_t state, uint32_t index)
{
    const GlTouchedState& row = glTouchedStates()[state];
    const size_t slot = firstSlots()[state] + index;
    if (index >= row.count || isSaved_[slot])
        return;
    row.save(device_->gl, row.what, index, saved_[slot]);
    isSaved_[slot] = true;
}

void GlStateGuard::touch(GlStateGroup group, uint32_t index)
{
    const auto states = glTouchedStates();
    for (size_t i = 0; i < states.size() && device_; ++i)
        if (states[i].group == group)
            save(i, index);
}

void GlStateGuard::touchAll()
{
    const auto states = glTouchedStates();
    for (size_t i = 0; i < states.size() && device_; ++i)
        for (uint32_t index = 0; index < states[i].count; ++index)
            save(i, index);
    restoresAll_ = true;
}

bool GlStateGuard::isOff(GLenum what) const
{
    const size_t state = offState(what);
    return state != kNone && !restoresAll_ &&
           saved_[firstSlots()[state] + (what - glTouchedStates()[state].what)].integers[0] == 0;
}

GlStateGuard::~GlStateGuard()
{
    if (!device_)
        return;
    const auto states = glTouchedStates();
    for (size_t i = states.size(); i-- > 0;)
        for (uint32_t index = states[i].count; index-- > 0;) {
            const size_t slot = firstSlots()[i] + index;
            const bool isStillOff =
                states[i].group == GlStateGroup::Off && !restoresAll_ && saved_[slot].integers[0] == 0;
            if (isSaved_[slot] && !isStillOff)
                states[i].restore(device_->gl, states[i].what, index, saved_[slot]);
        }
    device_->guard = outer_;
    (void)device_->takeError(
        "restoring the host's state"); // a name that was bound though deleted cannot come back
}

void touchState(GlDevice& device, GlStateGroup group, uint32_t index)
{
    if (device.guard)
        device.guard->touch(group, index);
}

} // namespace fx::render
