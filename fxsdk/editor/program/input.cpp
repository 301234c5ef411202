#include "fxsdk/editor/program/input.h"

#include "fxsdk/editor/panels/imgui_version.h"

#include <algorithm>
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

constexpr int kShift = 340, kControl = 341, kAlt = 342, kSuper = 343; // of GLFW
constexpr int kRightOf = 4; // from a modifier on the left to that on the right

bool isModifier(int code, int left)
{
    return code == left || code == left + kRightOf;
}

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
void turnWheel(float steps, float sideways)
{
    ImGui::GetIO().AddMouseWheelEvent(sideways, steps);
}

namespace {

void set(const NamedKey& key, bool isDown)
{
    ImGui::GetIO().AddKeyEvent(key.key, isDown);
}
void setControl(bool isDown)
{
    ImGui::GetIO().AddKeyEvent(kControlKey, isDown);
}
void setShift(bool isDown)
{
    ImGui::GetIO().AddKeyEvent(kShiftKey, isDown);
}
void setAlt(bool isDown)
{
    ImGui::GetIO().AddKeyEvent(kAltKey, isDown);
}
void setSuper(bool isDown)
{
    ImGui::GetIO().AddKeyEvent(kSuperKey, isDown);
}
void setCode(int code, bool isDown)
{
    for (const NamedKey& key : kKeys)
        if (key.code == code)
            set(key, isDown);
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

void turnWheel(float steps, float sideways)
{
    ImGui::GetIO().MouseWheel += steps;
    ImGui::GetIO().MouseWheelH += sideways;
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

void setAlt(bool isDown)
{
    ImGui::GetIO().KeyAlt = isDown;
}

void setSuper(bool isDown)
{
    ImGui::GetIO().KeySuper = isDown;
}

void setCode(int code, bool isDown)
{
    if (code >= 0 && code < IM_ARRAYSIZE(ImGui::GetIO().KeysDown))
        ImGui::GetIO().KeysDown[code] = isDown;
}

} // namespace

#endif

void applyInput(const std::vector<InputEvent>& events)
{
    for (const InputEvent& event : events)
        switch (event.kind) {
        case InputKind::Key:
            if (isModifier(event.code, kControl))
                setControl(event.isDown);
            if (isModifier(event.code, kShift))
                setShift(event.isDown);
            if (isModifier(event.code, kAlt))
                setAlt(event.isDown);
            if (isModifier(event.code, kSuper))
                setSuper(event.isDown);
            setCode(event.code, event.isDown);
            break;
        case InputKind::Text:
            ImGui::GetIO().AddInputCharacter(unsigned(event.code));
            break;
        case InputKind::Button:
            if (event.code >= 0 && event.code < 3)
                pressMouse(event.code, event.isDown);
            break;
        case InputKind::Motion:
            moveMouse(float(event.x), float(event.y));
            break;
        case InputKind::Wheel:
            turnWheel(float(event.y), float(event.x));
            break;
        }
}

void typeText(const std::string& text)
{
    ImGui::GetIO().AddInputCharactersUTF8(text.c_str());
}

namespace {

/// A key with what is held with it.
struct Chord
{
    bool isControl = false;
    bool isShift = false;
    const NamedKey* key = nullptr; ///< null: it is unknown
};

Chord chordOf(std::string_view name)
{
    const auto takePrefix = [&](std::string_view prefix) {
        const bool has = name.starts_with(prefix);
        name.remove_prefix(has ? prefix.size() : 0);
        return has;
    };
    Chord chord;
    chord.isControl = takePrefix("ctrl+");
    chord.isShift = takePrefix("shift+");
    const auto* const found =
        std::find_if(kKeys.begin(), kKeys.end(), [&](const NamedKey& key) { return key.name == name; });
    chord.key = found == kKeys.end() ? nullptr : found;
    return chord;
}

} // namespace

bool pressKey(const std::string& name, bool isDown)
{
    const Chord chord = chordOf(name);
    if (!chord.key)
        return false;
    if (chord.isControl)
        setControl(isDown);
    if (chord.isShift)
        setShift(isDown);
    set(*chord.key, isDown);
    return true;
}

bool strikeKey(const std::string& name, InputQueue& io)
{
    const Chord chord = chordOf(name);
    if (!chord.key)
        return false;
    const auto push = [&](int code, bool isDown) { io.push({InputKind::Key, code, isDown, 0.0, 0.0}); };
    for (const bool isDown : {true, false}) {
        if (chord.isControl)
            push(kControl, isDown);
        if (chord.isShift)
            push(kShift, isDown);
        push(chord.key->code, isDown);
    }
    return true;
}

} // namespace fx::editor
