/// @file fragment_sizes.h
/// Distribution of the sizes of fragments.
///
/// @formula fragment-sizes
/// Diameter of a fragment from a uniform random number, by inverting the number of fragments larger than a
/// size.
///
/// symbol   unit   meaning
///   u       1      uniform in [0, 1)
///   d       m      diameter; a, b the smallest and largest
///   m, mm   kg     mass of a fragment, mean mass of all; m ~ d^3
///   g       m      diameter of the fragment of mean mass
///   p       1      exponent
///   x       1      (2 m / mm)^(1/2) = 2^(1/2) (d/g)^(3/2)
/// @derivation
///   Mott: N(>m) ~ exp(-(2 m / mm)^(1/2)), so x is exponential between x_a and x_b:
///       x = -ln(e^-x_a - u (e^-x_a - e^-x_b))                                     (1)
///       d = g (x^2 / 2)^(1/3)                                                     (2)
///   power law: N(>d) ~ d^-p between a and b:
///       d = a (1 - u (1 - (a/b)^p))^(-1/p)                                        (3)
/// @source    [MOT47] for (1) with the exponent 1/2 of pieces of a shell; (3) is elementary
/// @deviation truncated at a and b
/// @valid     0 < a <= b, g > 0, p > 0; the result is clamped to [a, b]
/// @accuracy  float rounding
/// @tests     tests/simulation/fragments/test_fragment_sizes.cpp
#pragma once

#include "simulation/fragments/fragments_def.h"

namespace fx::sim {

/// [m] Diameter of a fragment, drawn by a uniform random number u in [0, 1). The diameter increases with u
/// and is smallest at u = 0.
float fragmentSize(const FragmentsDef& def, float u);

} // namespace fx::sim
