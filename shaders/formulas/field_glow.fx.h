/// @formula field-glow
/// Mean radiance inside of a medium due to its own emission, from rays along the lines of
/// a grid of cubes.
///
/// symbol     unit        meaning
///   k, j     1/m, ./m    extinction and emission of a cell, even within it
///   l        m           length of a ray's way through a cell
///   tau      1           k l
///   e        1           share of what is emitted on the way that leaves the cell; r see (3)
///   I, I'    .           radiance of a ray before and behind the cell; M its mean within, N in its middle
///   J1       .           mean over all directions of M of the emitted light
///   J2       .           mean over all directions of N of emitted light and what of J1 the medium scatters
///   w        1           albedo of the cell
/// @derivation
///   Rays in the 26 directions from a cell to its neighbors meet the middles of cells alone. Within one of
///   them
///       I' = I exp(-tau) + j l e,  e = (1 - exp(-tau)) / tau                                  (1)
///       M = I e + j l r                                                                       (2)
///       r = (1 - e) / tau                                                                     (3)
///   and what the cell absorbs and scatters is k l M = I + j l - I', exactly what is missing behind it: no
///   light is made or lost. J is the sum of M with the weights of Lebedev's rule, 1/21, 4/105 and 9/280 for
///   neighbors at a face, an edge and a corner, which sum up to 1. Deep in an even medium J = M = j / k.
///   Behind a layer of soot the light of a fire is less than the mean of the layer's cells, and it falls by a
///   factor from cell to cell. So what is seen is the light in the middle of cells,
///       N = I exp(-tau / 2) + (j l / 2) e(tau / 2)                                            (4)
///   and between the middles the logarithm is linear. Each order of scattering is the light of the one before
///   it times the albedo, spread out. With a ratio q of two orders that does not change and is no more than
///   the albedo,
///       J = J2 / (1 - q^2),  q = clamp(J2 / J1 - 1, 0, min(w, 0.95))                          (5)
///   so that deep in an even medium of albedo w up to 0.95, where J1 = (1 - w) B and J2 = (1 + w) J1, J = B.
/// @source    [LEB76] the weights; (5) is Aitken's delta-squared process; the rest is elementary
/// @deviation 26 directions: light of a source that is seen under a small angle comes in rays
/// @valid     tau, J1, J2 >= 0
/// @accuracy  e within 1e-6, r within 1e-4, J within 1e-6 of double, relative to 1; GLSL likewise. Of a ball
/// of 3
///            cells radius at 2 to 4 radii: mean over directions within 6 %, rms 0.5
/// @tests     tests/rendering/field/test_field_glow.cpp
FX_FORMULA(fxGlowShare)(FX_REAL tau)
{
    FX_REAL thin = FX_REAL(1.0) - tau * (FX_REAL(0.5) - tau * FX_REAL(0.166666666666667));
    FX_REAL thick = (FX_REAL(1.0) - exp(-tau)) / max(tau, FX_REAL(0.03));
    return tau < FX_REAL(0.03) ? thin : thick; // (1)
}

FX_FORMULA(fxGlowRest)(FX_REAL tau)
{
    FX_REAL thin = FX_REAL(0.5) - tau * (FX_REAL(0.166666666666667) - tau * FX_REAL(0.0416666666666667));
    FX_REAL thick = (FX_REAL(1.0) - fxGlowShare(tau)) / max(tau, FX_REAL(0.03));
    return tau < FX_REAL(0.03) ? thin : thick; // (3)
}

FX_FORMULA(fxGlowOrders)(FX_REAL J1, FX_REAL J2, FX_REAL w)
{
    FX_REAL one = FX_REAL(1.0);
    FX_REAL q = clamp(J2 / max(J1, FX_REAL(1e-30)) - one, FX_REAL(0.0), min(w, FX_REAL(0.95)));
    return J2 / (one - q * q); // (5)
}
