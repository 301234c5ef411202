/// @file depth_contacts.h
#pragma once

#include "fxsdk/scene_file/scene_file.h"

namespace fx::cli {

/// True when particles of the scene collide with what the view sees, and no other effect lights the stage:
/// lights are read from snapshots, and a reader of snapshots gets particles computed on the CPU.
bool showsDepthContacts(const scene_file::SceneFile& file);

} // namespace fx::cli
