#include "fxsdk/editor/program/input.h"

#include <imgui.h>

#include <array>
#include <string_view>

namespace fx::editor {

namespace {

struct NamedKey
{
    std::string_view name;
    ImGuiKey key;
    int code; ///< of GLFW, by which ImGui before 1.87 knows keys
};

constexpr auto kKeys = std::to_array<NamedKey>({
    {"tab", ImGuiKey_Tab, 258}, {"left", ImGuiKey_LeftArrow, 263}, {"right", ImGuiKey_RightArrow, 262},
        {"up", ImGuiKey_UpArrow, 265}, {"down", ImGuiKey_DownArrow, 264}, {"pageup", ImGuiKey_PageUp, 266},
        {"pagedown", ImGuiKey_PageDown, 267}, {"home", ImGuiKey_Home, 268}, {"end", ImGuiKey_End, 269},
        {"delete", ImGuiKey_Delete, 261}, {"backspace", ImGuiKey_Backspace, 259},
        {"space", ImGuiKey_Space, 32}, {"enter", ImGuiKey_Enter, 257}, {"escape", ImGuiKey_Escape, 256},
        {"a", ImGuiKey_A, 'A'}, {"c", ImGuiKey_C, 'C'}, {"v", ImGuiKey_V, 'V'}, {"x", ImGuiKey_X, 'X'},
        {"y", ImGuiKey_Y, 'Y'}, {"z", ImGuiKey_Z, 'Z'},
#if IMGUI_VERSION_NUM >= 18700
        {"s", ImGuiKey_S, 'S'},
#else
        {"s", ImGuiKey_COUNT, 'S'}, // has a code, but no name
#endif
});

} // namespace

#if IMGUI_VERSION_NUM >= 18700

void startInput() {}
void moveMouse(float x, float y)
{
    ImGui::GetIO().AddMousePosEvent(x, y);
}
void pressMouse(int button, bool isDown)
{
    ImGui::GetIO().AddMouseButtonEvent(button, isDown);
}
void turnWheel(float steps)
{
    ImGui::GetIO().AddMouseWheelEvent(0.0f, steps);
}

namespace {

void set(const NamedKey& key, bool isDown)
{
    ImGui::GetIO().AddKeyEvent(key.key, isDown);
}
void setControl(bool isDown)
{
    ImGui::GetIO().AddKeyEvent(ImGuiMod_Ctrl, isDown);
}
void setShift(bool isDown)
{
    ImGui::GetIO().AddKeyEvent(ImGuiMod_Shift, isDown);
}

} // namespace

#else

void startInput()
{
    for (const NamedKey& key : kKeys)
        if (key.key != ImGuiKey_COUNT)
            ImGui::GetIO().KeyMap[key.key] = key.code;
}

void moveMouse(float x, float y)
{
    ImGui::GetIO().MousePos = {x, y};
}

void pressMouse(int button, bool isDown)
{
    ImGui::GetIO().MouseDown[button] = isDown;
}

void turnWheel(float steps)
{
    ImGui::GetIO().MouseWheel += steps;
}

namespace {

void set(const NamedKey& key, bool isDown)
{
    ImGui::GetIO().KeysDown[key.code] = isDown;
}

void setControl(bool isDown)
{
    ImGui::GetIO().KeyCtrl = isDown;
}

void setShift(bool isDown)
{
    ImGui::GetIO().KeyShift = isDown;
}

} // namespace

#endif

void typeText(const std::string& text)
{
    ImGui::GetIO().AddInputCharactersUTF8(text.c_str());
}

bool pressKey(const std::string& name, bool isDown)
{
    std::string_view rest = name;
    const auto takePrefix = [&](std::string_view prefix) {
        const bool has = rest.starts_with(prefix);
        rest.remove_prefix(has ? prefix.size() : 0);
        return has;
    };
    const bool isControl = takePrefix("ctrl+");
    const bool isShift = takePrefix("shift+");
    for (const NamedKey& key : kKeys)
        if (key.name == rest) {
            if (isControl)
                setControl(isDown);
            if (isShift)
                setShift(isDown);
            set(key, isDown);
            return true;
        }
    return false;
}

} // namespace fx::editor
