/// @file volume_composition.h
/// Balls of each effect summed up in voxels, through which rays march.
#pragma once

#include "rendering/compositions/media_composition.h"

namespace fx::render {

extern const MediaComposition kVolumeComposition;

} // namespace fx::render
