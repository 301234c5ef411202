/// @formula detail-noise
/// Smooth noise from three octaves of a triply periodic surface function, cheap enough for every fragment.
///
/// symbol    unit   meaning
///   x, y, z 1      position in noise periods
///   n       1      noise, |n| <= 1, mean 0
/// @derivation
///   p(a) = 16 s (1/2 - |s|), s = fract(a) - 1/2, is a parabola approximation of a sine of period 1   (1)
///   The gyroid g = p(x) p(y + 1/4) + p(y) p(z + 1/4) + p(z) p(x + 1/4) lies in [-27/16, 27/16]         (2)
///   Octaves are rotated, and each is shifted by the one before it, which breaks the lattice:
///       n = (4 g1 + 2 g2 + g3) / 12                                                                   (3)
/// @source    own; the gyroid is Schoen's minimal surface
/// @deviation none
/// @valid     |x|, |y|, |z| < 1e5 in float
/// @accuracy  GLSL and C++ agree within 1e-4 for |x| < 100
/// @tests     tests/rendering/core/test_formulas.cpp
FX_FORMULA(fxNoiseWave)(FX_REAL a)
{
    FX_REAL s = fract(a) - FX_REAL(0.5);
    return FX_REAL(16.0) * s * (FX_REAL(0.5) - abs(s)); // (1)
}

FX_FORMULA(fxGyroid)(FX_REAL x, FX_REAL y, FX_REAL z)
{
    return fxNoiseWave(x) * fxNoiseWave(y + FX_REAL(0.25)) + fxNoiseWave(y) * fxNoiseWave(z + FX_REAL(0.25)) +
           fxNoiseWave(z) * fxNoiseWave(x + FX_REAL(0.25)); // (2)
}

FX_FORMULA(fxDetailNoise)(FX_REAL x, FX_REAL y, FX_REAL z)
{
    FX_REAL g1 = fxGyroid(x, y, z);
    FX_REAL x2 = FX_REAL(1.62) * x - FX_REAL(1.21) * z + FX_REAL(0.23) * g1;
    FX_REAL y2 = FX_REAL(2.03) * y + FX_REAL(0.31) * g1;
    FX_REAL z2 = FX_REAL(1.21) * x + FX_REAL(1.62) * z + FX_REAL(0.17);
    FX_REAL g2 = fxGyroid(x2, y2, z2);
    FX_REAL x3 = FX_REAL(2.07) * x2 + FX_REAL(0.37) * g2;
    FX_REAL y3 = FX_REAL(1.69) * y2 - FX_REAL(1.17) * z2 + FX_REAL(0.41);
    FX_REAL z3 = FX_REAL(1.17) * y2 + FX_REAL(1.69) * z2 + FX_REAL(0.29) * g2;
    FX_REAL g3 = fxGyroid(x3, y3, z3);
    return (FX_REAL(4.0) * g1 + FX_REAL(2.0) * g2 + g3) / FX_REAL(12.0); // (3)
}
