/// @file slab_composition.h
/// Media in slabs across each ray: what overlaps is summed up, so that no order is seen.
#pragma once

#include "rendering/compositions/media_composition.h"

namespace fx::render {

extern const MediaComposition kSlabComposition;

} // namespace fx::render
