/// @file blob_technique.h
/// Spherical billboards: fire, smoke and dust as balls of medium, and far effects as pictures of themselves.
#pragma once

#include "rendering/techniques/draw_technique.h"

namespace fx::render {

extern const DrawTechnique kBlobTechnique;

/// Coordinates of balls, by which their detail moves with them. The view of kBlobTechnique reads and draws
/// them.
extern const DrawTechnique kFieldDetailTechnique;

} // namespace fx::render
