/// @file slab_composition.h
/// Composition of media by slabs across each ray. Overlapping media are summed, so the result does not depend
/// on their order.
#pragma once

#include "rendering/compositions/media_composition.h"

namespace fx::render {

extern const MediaComposition kSlabComposition;

} // namespace fx::render
