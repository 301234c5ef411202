/// @file input.h
/// Mouse and keyboard of a program without a display, for every version of ImGui from 1.86 on.
#pragma once

#include <string>

namespace fx::editor {

/// Makes ImGui understand keys. Call it once per context.
void startInput();

void moveMouse(float x, float y);         ///< [pixel]
void pressMouse(int button, bool isDown); ///< 0: left, 1: right, 2: middle
void turnWheel(float steps);              ///< above 0: away from the user
void typeText(const std::string& text);   ///< UTF-8
/// Presses or releases a key such as "ctrl+z" or "enter". @return false if it is unknown
bool pressKey(const std::string& name, bool isDown);

} // namespace fx::editor
