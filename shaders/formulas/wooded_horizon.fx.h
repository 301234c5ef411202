/// @formula wooded-horizon
/// Outline of wooded hills around the horizon, as the tangent of its elevation.
///
/// symbol    unit   meaning
///   x, z    1      horizontal unit vector
///   c       1      number of noise cells around the horizon
///   p       1      width of a pixel as a tangent, >= 0
///   n       1      noise of soil-texture
///   h       1      tangent of the elevation of the outline
///   e       1      tangent of the elevation of a direction
/// @derivation
///   On a circle of radius c / (2 pi) in the plane of the noise a turn crosses about c cells and has no seam.
///   Octaves that are finer than a pixel fade out by the band b of lump-noise:
///       o(c) = b(2 pi / c, p) n(c x / (2 pi), c z / (2 pi))                                   (1)
///   Distant hills are broad, trees in front of them are ragged:
///       far:  h = 0.0135 + 0.018 o(14) + 0.006 o(61) + 0.0012 o(900)                          (2)
///       near: h = 0.0045 + 0.006 o(33) + 0.0045 o(190) + 0.0035 o(780) + 0.0025 o(2900)       (3)
///   The share of a pixel below a straight outline, for one that is nearly level:
///       clamp((h - e) / p + 1/2, 0, 1)                                                        (4)
/// @source    own
/// @deviation (4) takes pixels as squares whose sides are level
/// @valid     p >= 0; p = 0 gives a step in (4)
/// @accuracy  GLSL and C++ agree within 1e-5 of (2) and (3)
/// @tests     tests/rendering/core/test_soil_texture.cpp
FX_FORMULA(fxHillOctave)(FX_REAL x, FX_REAL z, FX_REAL c, FX_REAL p)
{
    FX_REAL radius = c * FX_REAL(0.159154943);
    return fxOctaveBand(FX_REAL(1.0) / radius, p) * fxSoilNoise(radius * x, radius * z); // (1)
}

FX_FORMULA(fxFarHills)(FX_REAL x, FX_REAL z, FX_REAL p)
{
    return FX_REAL(0.0135) + FX_REAL(0.018) * fxHillOctave(x, z, FX_REAL(14.0), p) +
           FX_REAL(0.006) * fxHillOctave(x, z, FX_REAL(61.0), p) +
           FX_REAL(0.0012) * fxHillOctave(x, z, FX_REAL(900.0), p); // (2)
}

FX_FORMULA(fxNearTrees)(FX_REAL x, FX_REAL z, FX_REAL p)
{
    return FX_REAL(0.0045) + FX_REAL(0.006) * fxHillOctave(x, z, FX_REAL(33.0), p) +
           FX_REAL(0.0045) * fxHillOctave(x, z, FX_REAL(190.0), p) +
           FX_REAL(0.0035) * fxHillOctave(x, z, FX_REAL(780.0), p) +
           FX_REAL(0.0025) * fxHillOctave(x, z, FX_REAL(2900.0), p); // (3)
}

FX_FORMULA(fxShareBelow)(FX_REAL h, FX_REAL e, FX_REAL p)
{
    return clamp((h - e) / max(p, FX_REAL(1e-9)) + FX_REAL(0.5), FX_REAL(0.0), FX_REAL(1.0)); // (4)
}
