/// @file input.h
/// Mouse and keyboard of a program without a display, for every version of ImGui from 1.86 on.
#pragma once

#include "fxsdk/editor/session/input_queue.h"

#include <string>
#include <vector>

namespace fx::editor {

/// Makes ImGui understand keys. Call it once per context.
void startInput();

void moveMouse(float x, float y);         ///< [pixel]
void pressMouse(int button, bool isDown); ///< 0: left, 1: right, 2: middle
/// @param steps above 0: away from the user
/// @param sideways steps of a second wheel, above 0: to the left
void turnWheel(float steps, float sideways = 0.0f);
void typeText(const std::string& text); ///< UTF-8
/// Presses or releases a key such as "ctrl+z" or "enter". @return false if it is unknown
bool pressKey(const std::string& name, bool isDown);

/// Gives ImGui the events of a frame, in their order. Numbers of keys are those of GLFW.
void applyInput(const std::vector<InputEvent>& events);
/// Appends the press and the release of a key such as "ctrl+z". @return false if it is unknown
bool strikeKey(const std::string& name, InputQueue& io);

} // namespace fx::editor
