/// @file instance_motion.h
/// Gives the instances of a scene the motion that the editor's view chooses.
#pragma once

#include "fxsdk/editor/session/motion_choice.h"
#include "fxsdk/scene_file/scene_file.h"

namespace fx::editor {

/// @param stillTime [s] scene time whose place Still shows
void setMotion(const MotionChoice& motion, double stillTime, scene_file::SceneInstance& io);

/// Whether an instance moves, or changes otherwise, so that its steps must be played in order.
bool isPlayed(const scene_file::SceneFile& file);

} // namespace fx::editor
