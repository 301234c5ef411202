/// @file media_compositions.h
/// The list of built-in compositions.
#pragma once

#include "rendering/compositions/media_composition.h"

namespace fx::render {

/// Divides each ray into depth intervals (slabs), and sums overlapping media in each slab.
extern const MediaComposition kSlabComposition;

/// Sums the balls of each effect in voxels, and marches rays through the voxels.
extern const MediaComposition kVolumeComposition;

std::span<const MediaComposition* const> mediaCompositions();

/// Returns the composition for a value, or null if the composition is not built in.
const MediaComposition* findComposition(Composition value);

} // namespace fx::render
