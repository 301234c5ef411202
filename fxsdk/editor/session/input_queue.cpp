#include "fxsdk/editor/session/input_queue.h"

#include <algorithm>

namespace fx::editor {

namespace {

constexpr int kFirstCommand = 256; // numbers of keys without a character begin here
constexpr int kFirstModifier = 340, kLastModifier = 347;

bool isModifier(const InputEvent& event)
{
    return event.kind == InputKind::Key && event.code >= kFirstModifier && event.code <= kLastModifier;
}

/// Enter, tab, arrows and the like change what the text or command after them means.
bool isCommand(const InputEvent& event)
{
    return event.kind == InputKind::Key && event.isDown && event.code >= kFirstCommand && !isModifier(event);
}

/// Whether a modifier changes what the event means. A frame sees modifiers as they are after all of its
/// events.
bool isModified(const InputEvent& event)
{
    return event.kind != InputKind::Motion && !isModifier(event);
}

/// Whether a frame that has seen `before` can also see `event`.
bool canFollow(const InputEvent& before, const InputEvent& event)
{
    switch (event.kind) {
    case InputKind::Key:
        return !(isModifier(event) && isModified(before)) && before.kind != InputKind::Button &&
               !(isCommand(before) && isCommand(event)) &&
               !(before.kind == InputKind::Key && before.code == event.code);
    case InputKind::Text:
        return before.kind != InputKind::Button && !isCommand(before);
    case InputKind::Button:
        return !isCommand(before) && before.kind != InputKind::Text && before.kind != InputKind::Wheel &&
               !(before.kind == InputKind::Button && before.code == event.code);
    case InputKind::Motion:
        return before.kind != InputKind::Button && before.kind != InputKind::Wheel;
    case InputKind::Wheel:
        return before.kind != InputKind::Button && before.kind != InputKind::Motion;
    }
    return true;
}

} // namespace

void InputQueue::push(const InputEvent& event)
{
    const bool hasState = event.kind == InputKind::Key || event.kind == InputKind::Button;
    if (hasState) {
        std::erase_if(down_, [&](const InputEvent& other) {
            return other.kind == event.kind && other.code == event.code;
        });
        if (event.isDown)
            down_.push_back(event);
    }
    if (event.kind == InputKind::Motion && !waiting_.empty() && waiting_.back().kind == InputKind::Motion)
        waiting_.back() = event;
    else
        waiting_.push_back(event);
}

void InputQueue::releaseAll()
{
    const std::vector<InputEvent> down = down_;
    for (InputEvent event : down) {
        event.isDown = false;
        push(event);
    }
}

std::vector<InputEvent> InputQueue::take()
{
    std::vector<InputEvent> taken;
    const bool takesAll = waiting_.size() > kMost;
    while (!waiting_.empty()) {
        const InputEvent& next = waiting_.front();
        const bool fits = std::all_of(taken.begin(), taken.end(),
                                      [&](const InputEvent& before) { return canFollow(before, next); });
        if (!fits && !takesAll)
            break;
        taken.push_back(next);
        waiting_.pop_front();
    }
    return taken;
}

} // namespace fx::editor
