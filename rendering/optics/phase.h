/// @file phase.h
/// Phase functions: which way a medium scatters light.
#pragma once

#include <cmath>
#include <numbers>

namespace fx::render {

/// @formula henyey-greenstein
/// Share of scattered light that leaves per solid angle at an angle to its old direction.
///
/// symbol     unit   meaning
///   cosine   1      of the angle between old and new direction, -1..1; 1 is straight on
///   g        1      mean cosine, (-1, 1); 0 is isotropic
///   p        1/sr   phase function
/// @derivation p = (1 - g^2) / (4 pi (1 + g^2 - 2 g cosine)^(3/2))                               (1)
/// @source    [HG41] Henyey & Greenstein, doi:10.1086/144246
/// @deviation none
/// @valid     |g| < 1
/// @accuracy  integrates to 1 over the sphere within 1e-6 for |g| <= 0.9
/// @tests     tests/rendering/core/test_optics.cpp
inline float henyeyGreenstein(float cosine, float g)
{
    const float d = 1.0f + g * g - 2.0f * g * cosine;
    return (1.0f - g * g) / (4.0f * std::numbers::pi_v<float> * d * std::sqrt(d)); // (1)
}

} // namespace fx::render
