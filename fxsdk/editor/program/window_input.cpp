#include "fxsdk/editor/program/window_input.h"

#include "fxsdk/editor/program/input.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <imgui.h>
#include <imgui_impl_glfw.h>

#include <algorithm>
#include <cfloat>

namespace fx::editor {

#if IMGUI_VERSION_NUM >= 18700

WindowInput::WindowInput(GLFWwindow* window)
    : window_(window), isListening_(ImGui_ImplGlfw_InitForOpenGL(window, true)), mouse_{}
{}

void WindowInput::listen() {}

void WindowInput::beginFrame()
{
    ImGui_ImplGlfw_NewFrame();
}

#else

namespace {

constexpr double kNowhere = -double(FLT_MAX); // ImGui's place of a mouse outside of the window

/// The key that a letter or digit has in the layout of the keyboard, as shortcuts name it.
int inLayout(int key, int scancode)
{
    const char* const name = key < GLFW_KEY_ESCAPE ? glfwGetKeyName(key, scancode) : nullptr;
    if (!name || name[0] == 0 || name[1] != 0)
        return key;
    const char letter = name[0];
    if (letter >= 'a' && letter <= 'z')
        return letter - 'a' + GLFW_KEY_A;
    return letter >= '0' && letter <= '9' ? letter - '0' + GLFW_KEY_0 : key;
}

/// Whether a button is down, so that the window follows the mouse beyond its edge.
bool isDragging(GLFWwindow* window)
{
    for (int button = GLFW_MOUSE_BUTTON_1; button <= GLFW_MOUSE_BUTTON_3; ++button)
        if (glfwGetMouseButton(window, button) == GLFW_PRESS)
            return true;
    return false;
}

InputQueue& queueOf(GLFWwindow* window)
{
    return *static_cast<InputQueue*>(glfwGetWindowUserPointer(window));
}

} // namespace

WindowInput::WindowInput(GLFWwindow* window)
    : window_(window), isListening_(ImGui_ImplGlfw_InitForOpenGL(window, false)), mouse_{kNowhere, kNowhere}
{
    if (isListening_)
        listen();
}

void WindowInput::listen()
{
    glfwSetWindowUserPointer(window_, &queue_);
    glfwSetKeyCallback(window_, [](GLFWwindow* window, int key, int scancode, int action, int) {
        if (action != GLFW_REPEAT && key >= 0) // ImGui repeats keys itself
            queueOf(window).push({InputKind::Key, inLayout(key, scancode), action == GLFW_PRESS, 0.0, 0.0});
    });
    glfwSetCharCallback(window_, [](GLFWwindow* window, unsigned character) {
        queueOf(window).push({InputKind::Text, int(character), false, 0.0, 0.0});
    });
    glfwSetMouseButtonCallback(window_, [](GLFWwindow* window, int button, int action, int) {
        queueOf(window).push({InputKind::Button, button, action == GLFW_PRESS, 0.0, 0.0});
    });
    glfwSetCursorPosCallback(window_, [](GLFWwindow* window, double x, double y) {
        queueOf(window).push({InputKind::Motion, 0, false, x, y});
    });
    glfwSetCursorEnterCallback(window_, [](GLFWwindow* window, int isInside) {
        double x = kNowhere, y = kNowhere;
        if (isInside != GLFW_FALSE)
            glfwGetCursorPos(window, &x, &y); // GLFW reports no motion if the mouse returns to its last place
        else if (isDragging(window))
            return;
        queueOf(window).push({InputKind::Motion, 0, false, x, y});
    });
    glfwSetScrollCallback(window_, [](GLFWwindow* window, double x, double y) {
        queueOf(window).push({InputKind::Wheel, 0, false, x, y});
    });
    glfwSetWindowFocusCallback(window_, [](GLFWwindow* window, int hasFocus) {
        ImGui_ImplGlfw_WindowFocusCallback(window, hasFocus);
        if (hasFocus == GLFW_FALSE)
            queueOf(window).releaseAll();
    });
}

void WindowInput::beginFrame()
{
    ImGui_ImplGlfw_NewFrame(); // polls the mouse, which the events of this frame replace
    const std::vector<InputEvent> events = queue_.take();
    applyInput(events);
    for (const InputEvent& event : events) {
        if (event.kind == InputKind::Motion)
            mouse_ = {event.x, event.y};
        if (event.kind == InputKind::Button && event.code >= 0 && size_t(event.code) < buttons_.size())
            buttons_[size_t(event.code)] = event.isDown;
    }
    moveMouse(float(mouse_[0]), float(mouse_[1]));
    for (size_t i = 0; i < buttons_.size(); ++i)
        pressMouse(int(i), buttons_[i]);
}

#endif

WindowInput::~WindowInput()
{
    if (isListening_)
        ImGui_ImplGlfw_Shutdown();
}

} // namespace fx::editor
