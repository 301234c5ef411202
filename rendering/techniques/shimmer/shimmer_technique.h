/// @file shimmer_technique.h
/// Heat shimmer: hot gas bends the light that passes through it.
#pragma once

#include "rendering/techniques/draw_technique.h"

namespace fx::render {

extern const DrawTechnique kShimmerTechnique;

} // namespace fx::render
