/// @file input_queue.h
/// Events of mouse and keyboard between two frames of a program that polls its state once a frame. A frame
/// sees each key only up or down: a press and its release within one slow frame would be lost, so the release
/// waits for the next frame. The order of all events is kept. A modifier, such as Ctrl, holds for the keys,
/// text, buttons and wheel steps after it, not for those before it.
///
/// Needed with Dear ImGui before 1.87, which has no queue of its own. Threads: one at a time.
#pragma once

#include <cstddef>
#include <deque>
#include <vector>

namespace fx::editor {

enum class InputKind
{
    Key,    ///< `code` is the number of the key, as of GLFW
    Text,   ///< `code` is a character of Unicode
    Button, ///< `code` is 0: left, 1: right, 2: middle
    Motion, ///< to x, y [pixel]
    Wheel   ///< x, y steps
};

struct InputEvent
{
    InputKind kind = InputKind::Key;
    int code = 0;
    bool isDown = false; ///< of Key and Button
    double x = 0.0;
    double y = 0.0;

    bool operator==(const InputEvent&) const = default;
};

class InputQueue
{
public:
    /// Beyond so many events a frame takes all of them: the program is far too slow to show each of them.
    static constexpr size_t kMost = 512;

    /// Appends an event. A motion after a motion replaces it.
    void push(const InputEvent& event);
    /// Releases keys and buttons that are down, as when a window loses the keyboard.
    void releaseAll();
    /// Removes the events of the next frame: up to the first that a frame cannot see together with those
    /// before.
    std::vector<InputEvent> take();
    size_t size() const { return waiting_.size(); }

private:
    std::deque<InputEvent> waiting_;
    std::vector<InputEvent> down_; ///< last presses that no release has followed
};

} // namespace fx::editor
