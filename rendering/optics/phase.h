/// @file phase.h
/// Phase functions of media: the distribution of the directions of scattered light.
#pragma once

#include "shaders/formulas/formula.h"

namespace fx::render {

/// Returns the Henyey-Greenstein phase function [1/sr], see shaders/formulas/henyey_greenstein.fx.h.
/// @param cosine cosine of the scattering angle, -1..1; 1: the direction does not change
/// @param g mean cosine, (-1, 1); 0 is isotropic
inline float henyeyGreenstein(float cosine, float g)
{
    return formula::fxHenyeyGreenstein(cosine, g);
}

} // namespace fx::render
