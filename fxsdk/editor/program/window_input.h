/// @file window_input.h
/// Mouse and keyboard of a window of GLFW for ImGui. With ImGui before 1.87 events wait in a queue, so that a
/// key that is pressed and released within one slow frame is seen; later versions have such a queue of their
/// own.
///
/// Threads: the main thread.
#pragma once

#include "fxsdk/editor/session/input_queue.h"

#include <array>

struct GLFWwindow;

namespace fx::editor {

class WindowInput
{
public:
    /// Listens to a window. Needs a current context of ImGui. The user pointer of the window belongs to this
    /// object.
    explicit WindowInput(GLFWwindow* window);
    ~WindowInput();
    WindowInput(const WindowInput&) = delete;
    WindowInput& operator=(const WindowInput&) = delete;

    bool isListening() const { return isListening_; }
    /// Begins a frame of ImGui for the window, before ImGui::NewFrame().
    void beginFrame();

private:
    void listen();

    GLFWwindow* window_;
    bool isListening_ = false;
    InputQueue queue_;
    std::array<double, 2> mouse_; ///< [pixel]
    std::array<bool, 3> buttons_{};
};

} // namespace fx::editor
