/// @file phase.h
/// Phase functions, which give the distribution of directions into which a medium scatters light.
#pragma once

#include "shaders/formulas/formula.h"

namespace fx::render {

/// Share of scattered light that leaves per solid angle [1/sr], see shaders/formulas/henyey_greenstein.fx.h.
/// @param cosine cosine of the angle between old and new direction, -1..1; 1 is no change of direction
/// @param g mean cosine, (-1, 1); 0 is isotropic
inline float henyeyGreenstein(float cosine, float g)
{
    return formula::fxHenyeyGreenstein(cosine, g);
}

} // namespace fx::render
