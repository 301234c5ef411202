/// @formula multiple-scattering
/// Light that a medium scatters towards the eye, also after it has been scattered many times before, from two
/// optical depths along the line of the light: cheap enough for every fragment.
///
/// symbol         unit   meaning
///   albedo       1      share of the extinction that scatters, 0..1
///   g            1      mean cosine of Henyey and Greenstein's phase function
///   cosine       1      between the way the light travels and the direction to the eye; 1: straight on
///   tauLight     1      optical depth between the light and the point
///   tauColumn    1      optical depth of the whole medium on the light's line through the point
///   source       1/sr   light scattered towards the eye per unit of extinction, for a light of illuminance 1
///   x, X         1      tauLight and tauColumn in lengths after which a direction is forgotten
///   f            1      share of the scattering that goes so nearly straight on that it belongs to the beam
///   b            1      extinction of such a beam per x
///   q, p         1      light that the beam loses to all sides per x, and its mean cosine times that light
///   k            1      diffuse light falls as exp(-k x)
///   phi, F       1      integral of the diffuse radiance over all directions; its flux along the light
/// @derivation
///   Light that is scattered once: albedo P(cosine, g) exp(-tauLight), P of henyey-greenstein          (1)
///   Of the rest a part follows the beam. With f = g^1.5 it soon is more than the light not yet
///   scattered, and is scattered again with a wider phase function:
///       w albedo P(cosine, g^2) (exp(-(1 - albedo f) tauLight) - exp(-tauLight))                      (2)
///   The other part is diffuse. Equal mean cosines of the deflection mean equal fields: with
///   s = 1 - albedo g
///       x = s tauLight, X = s tauColumn                                                               (3)
///       b = (1 - albedo f) / s, q = albedo (1 - f) / s, p = albedo (g - f) / s                        (4)
///   In Eddington's approximation, radiance (phi + 3 F cosine) / (4 pi),
///       F' = -a phi + q exp(-b x), phi' / 3 = -F + p exp(-b x), a = (1 - albedo) / s
///   so that phi'' = k^2 phi - 3 (q + b p) exp(-b x) with k^2 = 3 a. Light that leaves a cloud sideways
///   is lost to the line like absorbed light. A cloud is about as wide as it is deep, hence
///       k^2 = 3 a + (c1 / (X + c2))^2                                                                 (5)
///   which also is above 0 for albedo 1, so that no conservative case has to be told apart.
///       phi = A1 exp(-k x) + A2 exp(-k (X - x)) + C exp(-b x), C = -3 (q + b p) / (b^2 - k^2)         (6)
///       F = (k / 3) (A1 exp(-k x) - A2 exp(-k (X - x))) + D exp(-b x), D = b C / 3 + p                (7)
///   No diffuse light comes in at the ends: phi + 2 m F = 0 at x = 0, phi - 2 m F = 0 at X. With
///   B = exp(-k X), h = 2 m k / 3 and d = 2 m D these are two equations for A1 and A2:
///       A1 (1 + h) + A2 B (1 - h) = -(C + d),  A1 B (1 - h) + A2 (1 + h) = -(C - d) exp(-b X)         (8)
///   Of the flux only that along the light is kept: where F < 0, low orders outweigh the slope.
///       diffuse = albedo / (4 pi) max(n phi + 3 g u cosine max(F, 0), 0)                              (9)
///   b = k would divide by 0: |b^2 - k^2| is held above 0.001                                         (10)
///   c1, c2, m, n, u, w are fitted to the path tracer by scripts/fit_multiple_scattering.py. Without a
///   fit, m, n, u, w are 1, and c1 = 0 is an infinite slab.
/// @source    [JWW76] Eddington's approximation with a part of the scattering left in the beam;
///            [VDH80] the similarity of (3)
/// @deviation (2), (5) and max(F, 0) are own; f is g^2 in the paper; the constants are fitted
/// @valid     albedo 0..1, |g| < 1 (the multiple part takes g from 0 to 0.9), depths 0..1e4; a tauColumn
///            below tauLight is taken as tauLight
/// @accuracy  mean radiance of pictures of round clouds within 25 %, see
///            docs/howto/multiple-scattering.md; float within 1e-3 of double plus 2e-5; GLSL within 1e-3
///            plus 2e-4
/// @tests     tests/rendering/core/test_multiple_scattering.cpp, scripts/fit_multiple_scattering.py
FX_FORMULA(fxMultipleScattering)
(FX_REAL albedo, FX_REAL g, FX_REAL cosine, FX_REAL tauLight, FX_REAL tauColumn)
{
    FX_REAL c1 = FX_REAL(3.67); // fitted
    FX_REAL c2 = FX_REAL(2.15); // fitted
    FX_REAL m = FX_REAL(0.704); // fitted
    FX_REAL n = FX_REAL(0.960); // fitted
    FX_REAL u = FX_REAL(1.44);  // fitted
    FX_REAL w = FX_REAL(0.683); // fitted
    FX_REAL one = FX_REAL(1.0);
    FX_REAL o = clamp(albedo, FX_REAL(0.0), one);
    FX_REAL gm = clamp(g, FX_REAL(0.0), FX_REAL(0.9));
    FX_REAL f = gm * sqrt(gm); // (2)
    FX_REAL s = one - o * gm;
    FX_REAL x = s * tauLight;                                // (3)
    FX_REAL X = s * max(tauColumn, tauLight);                // (3)
    FX_REAL b = (one - o * f) / s;                           // (4)
    FX_REAL q = o * (one - f) / s;                           // (4)
    FX_REAL p = o * (gm - f) / s;                            // (4)
    FX_REAL side = c1 / (X + c2);                            // (5)
    FX_REAL k2 = FX_REAL(3.0) * (one - o) / s + side * side; // (5)
    FX_REAL apart = b * b - k2;
    FX_REAL gap = apart < FX_REAL(0.0) ? min(apart, FX_REAL(-0.001)) : max(apart, FX_REAL(0.001)); // (10)
    FX_REAL k = sqrt(k2 + (apart - gap));
    FX_REAL C = FX_REAL(-3.0) * (q + b * p) / gap; // (6)
    FX_REAL D = b * C / FX_REAL(3.0) + p;          // (7)
    FX_REAL d = FX_REAL(2.0) * m * D;
    FX_REAL h = FX_REAL(2.0) * m * k / FX_REAL(3.0);
    FX_REAL beam = exp(-b * x);
    FX_REAL away = exp(-k * x);
    FX_REAL back = exp(-k * (X - x));
    FX_REAL mirrored = away * back * (one - h);
    FX_REAL first = -(C + d);
    FX_REAL last = (d - C) * exp(-b * X);
    FX_REAL determinant = (one + h) * (one + h) - mirrored * mirrored;
    FX_REAL a1 = (first * (one + h) - last * mirrored) / determinant * away;              // (8)
    FX_REAL a2 = (last * (one + h) - first * mirrored) / determinant * back;              // (8)
    FX_REAL phi = a1 + a2 + C * beam;                                                     // (6)
    FX_REAL flux = k / FX_REAL(3.0) * (a1 - a2) + D * beam;                               // (7)
    FX_REAL diffuse = n * phi + FX_REAL(3.0) * gm * u * cosine * max(flux, FX_REAL(0.0)); // (9)
    FX_REAL along = exp(-(one - o * f) * tauLight) - exp(-tauLight);
    return o * (max(diffuse, FX_REAL(0.0)) * FX_REAL(0.0795774715459477) +
                w * along * fxHenyeyGreenstein(cosine, gm * gm)); // (2), (9)
}

FX_FORMULA(fxScatteredLight)
(FX_REAL albedo, FX_REAL g, FX_REAL cosine, FX_REAL tauLight, FX_REAL tauColumn)
{
    return albedo * fxHenyeyGreenstein(cosine, g) * exp(-tauLight) +
           fxMultipleScattering(albedo, g, cosine, tauLight, tauColumn); // (1)
}

/// @formula diffuse-sky
/// Light of a sky of radiance 1 that a medium scatters towards the eye, any number of times, from the
/// optical depths above and below.
///
/// symbol         unit   meaning
///   albedo, g    1      as in multiple-scattering
///   cosine       1      between straight down and the direction to the eye; 1: the eye looks up from below
///   tauUp        1      optical depth of the medium above the point
///   tauDown      1      optical depth of the medium below it
///   source       1      radiance scattered towards the eye per unit of extinction. The sky is all
///                       directions above the horizon; below it is black
///   x, z, X      1      depths above, below, of both, in lengths after which a direction is forgotten
///   S, A         1      mean radiance when the ground has radiance 1, -1
///   G            1      what forward scattering makes of a light on one side
/// @derivation
///   Lit by the sky alone, the mean radiance is (S + A) / 2. With s = 1 - albedo g, x = s tauUp,
///   z = s tauDown and a = (1 - albedo) / s, the diffusion of multiple-scattering without a beam is
///       S'' = 3 a S + l^2 (S - 1),  A'' = 3 a A + l^2 A,  l = c1 / (X + c2)                           (1)
///   where what comes in from the sides, which see as much sky as ground, is 1 and 0. k^2 = 3 a + l^2.
///   At the top S - m S' = 1 and A - m A' = 1, at the bottom S + m S' = 1 and A + m A' = -1.
///   With e = exp(-k x), r = exp(-k z):
///       S = S0 + (1 - S0) (e + r) / ((1 + m k) + (1 - m k) e r),  S0 = l^2 / k^2                      (2)
///       A = (e - r) / ((1 + m k) - (1 - m k) e r)                                                     (3)
///   Radiance that comes from above goes on downwards by forward scattering, in proportion to the slope:
///       source = albedo max(S + A - G cosine m (S' + A'), 0) / 2                                      (4)
///   In a thin medium -m A' = 1, where the share of the light that stays in its half of all directions,
///   (1 + G) / 2, is known for Henyey and Greenstein's function. Within 0.02 it is
///       G = 1.5 g / (1 + g^2 / 2)                                                                     (5)
///   Albedo 1 has S = 1. Between a sky and a ground of radiance 1 the source then is 1 at each point,
///   exactly: the ground's light is that of a sky seen upside down, with -cosine, tauDown, tauUp.
///   c1, c2, m are fitted to the path tracer by scripts/fit_multiple_scattering.py.
/// @source    [JWW76] for Eddington's approximation
/// @deviation (1) for the light of the sides and (5) are own, and the constants are fitted
/// @valid     albedo 0..1, g 0..0.9 (below 0 as for 0), depths 0..1e4
/// @accuracy  mean radiance of pictures of round clouds within 25 %, see
///            docs/howto/multiple-scattering.md; float within 1e-5 of double; GLSL within 1e-4; the white
///            medium within 1e-6
/// @tests     tests/rendering/core/test_multiple_scattering.cpp, scripts/fit_multiple_scattering.py
FX_FORMULA(fxDiffuseSky)
(FX_REAL albedo, FX_REAL g, FX_REAL cosine, FX_REAL tauUp, FX_REAL tauDown)
{
    FX_REAL c1 = FX_REAL(6.14); // fitted
    FX_REAL c2 = FX_REAL(2.80); // fitted
    FX_REAL m = FX_REAL(1.118); // fitted
    FX_REAL one = FX_REAL(1.0);
    FX_REAL o = clamp(albedo, FX_REAL(0.0), one);
    FX_REAL gm = clamp(g, FX_REAL(0.0), FX_REAL(0.9));
    FX_REAL s = one - o * gm;
    FX_REAL l = c1 / (s * (tauUp + tauDown) + c2);     // (1)
    FX_REAL k2 = FX_REAL(3.0) * (one - o) / s + l * l; // (1)
    FX_REAL k = sqrt(k2);
    FX_REAL e = exp(-k * s * tauUp);
    FX_REAL r = exp(-k * s * tauDown);
    FX_REAL plus = one + m * k;
    FX_REAL minus = (one - m * k) * e * r;
    FX_REAL S0 = l * l / k2;
    FX_REAL even = (one - S0) / (plus + minus); // (2)
    FX_REAL odd = one / (plus - minus);         // (3)
    FX_REAL mean = S0 + even * (e + r) + odd * (e - r);
    FX_REAL slope = m * k * (even * (e - r) + odd * (e + r));
    FX_REAL G = FX_REAL(1.5) * gm / (one + FX_REAL(0.5) * gm * gm);         // (5)
    return FX_REAL(0.5) * o * max(mean + G * cosine * slope, FX_REAL(0.0)); // (4)
}
