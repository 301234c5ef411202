/// @file media_compositions.h
/// The explicit list of compositions that are built in.
#pragma once

#include "rendering/compositions/media_composition.h"

namespace fx::render {

std::span<const MediaComposition* const> mediaCompositions();

/// Null: it is not built in.
const MediaComposition* findComposition(Composition value);

} // namespace fx::render
