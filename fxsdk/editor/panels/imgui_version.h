/// @file imgui_version.h
/// Names of Dear ImGui that differ between 1.86 and later versions. All other code of the panels uses names
/// that all of these versions have, and none that ImGui calls obsolete (IMGUI_DISABLE_OBSOLETE_FUNCTIONS).
#pragma once

#include <imgui.h>

#include <cstdint>

static_assert(IMGUI_VERSION_NUM >= 18600, "The panels of fxsdk need Dear ImGui 1.86 or later");

namespace fx::editor {

// Keys. From 1.87 on every key has a name; before, ImGui maps few names to the numbers of its host.
#if IMGUI_VERSION_NUM >= 18700
inline bool isKeyPressed(ImGuiKey key)
{
    return ImGui::IsKeyPressed(key, false);
}
inline bool isKeyDown(ImGuiKey key)
{
    return ImGui::IsKeyDown(key);
}
/// @param letter "A" to "Z"
inline bool isLetterPressed(char letter)
{
    return ImGui::IsKeyPressed(ImGuiKey(int(ImGuiKey_A) + (letter - 'A')), false);
}
#else
inline bool isKeyPressed(ImGuiKey key)
{
    return ImGui::IsKeyPressed(ImGui::GetKeyIndex(key), false);
}
inline bool isKeyDown(ImGuiKey key)
{
    return ImGui::IsKeyDown(ImGui::GetKeyIndex(key));
}
inline bool isLetterPressed(char letter)
{
    return ImGui::IsKeyPressed(letter, false); // GLFW, SDL and scripts number letters as ASCII does
}
#endif

// Keys that modify others, as events of a host.
#if IMGUI_VERSION_NUM >= 18900
constexpr ImGuiKey kControlKey = ImGuiMod_Ctrl;
constexpr ImGuiKey kShiftKey = ImGuiMod_Shift;
constexpr ImGuiKey kAltKey = ImGuiMod_Alt;
constexpr ImGuiKey kSuperKey = ImGuiMod_Super;
#elif IMGUI_VERSION_NUM >= 18700
constexpr ImGuiKey kControlKey = ImGuiKey_ModCtrl;
constexpr ImGuiKey kShiftKey = ImGuiKey_ModShift;
constexpr ImGuiKey kAltKey = ImGuiKey_ModAlt;
constexpr ImGuiKey kSuperKey = ImGuiKey_ModSuper;
#endif

#if IMGUI_VERSION_NUM >= 19100
constexpr int kKeepsPopup = ImGuiSelectableFlags_NoAutoClosePopups;
#else
constexpr int kKeepsPopup = ImGuiSelectableFlags_DontClosePopups;
#endif

/// Size of the text over that of its font.
inline void setTextScale(float scale)
{
#if IMGUI_VERSION_NUM >= 19200
    ImGui::GetStyle().FontScaleMain = scale;
#else
    ImGui::GetIO().FontGlobalScale = scale;
#endif
}

/// Begins a tooltip, which ImGui::EndTooltip() ends. @return false from 1.90 on where none is shown
inline bool beginTooltip()
{
#if IMGUI_VERSION_NUM >= 19000
    return ImGui::BeginTooltip();
#else
    ImGui::BeginTooltip();
    return true;
#endif
}

/// Right end of the line that the next widget begins [pixel]. Call it where no widget is on the same line.
inline float rightEnd()
{
    return ImGui::GetCursorScreenPos().x + ImGui::GetContentRegionAvail().x;
}

/// A texture of OpenGL: a pointer, or from 1.91.4 on an integer.
inline ImTextureID imageOf(uint32_t texture)
{
    return (ImTextureID)(uintptr_t)texture;
}

} // namespace fx::editor
