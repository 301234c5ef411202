/// @file media_compositions.h
/// The explicit list of compositions that are built in.
#pragma once

#include "rendering/compositions/media_composition.h"

namespace fx::render {

/// Slabs across each ray, in which overlapping media are summed.
extern const MediaComposition kSlabComposition;

/// Voxels in which the balls of each effect are summed, and through which rays march.
extern const MediaComposition kVolumeComposition;

std::span<const MediaComposition* const> mediaCompositions();

/// Null: it is not built in.
const MediaComposition* findComposition(Composition value);

} // namespace fx::render
