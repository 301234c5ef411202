/// @file depth_contacts.h
#pragma once

#include "fxsdk/scene_file/scene_file.h"

namespace fx::cli {

/// True when particles of the scene collide with the depth texture of the view and no other effect lights
/// the stage. If effects light the stage, their snapshots are read, and reading snapshots moves particles
/// to the CPU, where the depth texture is not available.
bool showsDepthContacts(const scene_file::SceneFile& file);

} // namespace fx::cli
