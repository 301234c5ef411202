/// @file fire_share.h
/// Fraction of hot matter that a picture shows as fire.
///
/// @formula fire-share
/// The part of a blob's opacity that counts as fire in the layers of a picture; the rest is smoke.
///
/// symbol   unit   meaning
///   T        K      temperature
///   T0       K      of the first visible glow
///   T1       K      at which the glow outshines daylight on smoke, > T0
///   F        1      share of fire
/// @derivation
///   u = (T - T0) / (T1 - T0) clamped to [0, 1],   F = u^2 (3 - 2 u)                         (1)
/// @source    elementary (cubic step); the temperatures depend on the matter: for gas they come from its
///            preset, for solid fragments from the colors of incandescence
/// @deviation none
/// @valid     T0 < T1; NaN gives 0
/// @accuracy  float rounding
/// @tests     tests/simulation/combustion/test_fire_share.cpp
#pragma once

#include "foundation/math/elementary.h"

namespace fx::sim {

/// [K] Range of temperatures in which matter changes from smoke to fire.
struct GlowRange
{
    float first;  ///< [K] symbol T0
    float bright; ///< [K] symbol T1
};

/// [1] Fraction F of matter at `temperature` [K] that a picture shows as fire.
inline float fireShareOf(float temperature, const GlowRange& glow)
{
    return base::smoothStep(glow.first, glow.bright, temperature); // (1)
}

} // namespace fx::sim
