/// @formula soil-texture
/// Relief and color of bare soil, from value noise of several sizes. GLSL and C++ use the same lattice.
///
/// symbol    unit   meaning
///   i, j    1      integers that name a corner of the lattice
///   v       1      value of a corner, -1/2..1/2
///   x, z    1      position in cells of the lattice, |x|, |z| < 1e5
///   n       1      noise, -1/2..1/2, mean 0
///   k       1      number of an octave, 0..6
///   l       m      size of a cell of an octave
///   s, a    1      slope and relative change of albedo of an octave for n' = 1 and n = 1
/// @derivation
///   (34 q + 1) q mod 289 permutes the integers 0..288. All products are below 2^24, so that floats are
///   exact:
///       P(q) = (34 q + 1) q mod 289, v = P(P(i mod 289) + j mod 289) / 288 - 1/2              (1)
///   Each row of the lattice contains each value once, so that the mean of n is exactly 0.
///   With u the fraction of x, w that of z, t = 3 u^2 - 2 u^3 and r the same of w:
///       n = mix(mix(v00, v10, t), mix(v01, v11, t), r)                                        (2)
///       dn/dx = 6 u (1 - u) mix(v10 - v00, v11 - v01, r)                                      (3)
///       dn/dz = 6 w (1 - w) mix(v01 - v00, v11 - v10, t)                                      (4)
///   Octaves have cells of 6 m down to 2.5 cm. Soil is steep at the size of clods and flat at that of fields:
///       l = 6 / 2.5^k, s = 0.55 / (1 + l / 0.25), a = 0.20 + 0.12 / (1 + l / 0.5)             (5)
///   Octave k is turned by k times 36.87 degrees and shifted, so that the lattices do not meet.
/// @source    [MSRG12] for the permutation of (1); (2) to (4) are the textbook value noise; (5) is a choice
/// @deviation none
/// @valid     |i|, |j| < 2^17
/// @accuracy  the integers of (1) are exact, v within 2^-23; (2) to (4) agree within 1e-4 for |x|, |z| < 100
/// @tests     tests/rendering/core/test_soil_texture.cpp
FX_FORMULA(fxSoilWrap)(FX_REAL q)
{
    return q - FX_REAL(289.0) * floor((q + FX_REAL(0.5)) / FX_REAL(289.0)); // (1)
}

FX_FORMULA(fxSoilPermuted)(FX_REAL q)
{
    return fxSoilWrap(fxSoilWrap(FX_REAL(34.0) * q + FX_REAL(1.0)) * q); // (1)
}

FX_FORMULA(fxSoilValue)(FX_REAL i, FX_REAL j)
{
    FX_REAL row = fxSoilPermuted(fxSoilWrap(i));
    return fxSoilPermuted(fxSoilWrap(row + fxSoilWrap(j))) / FX_REAL(288.0) - FX_REAL(0.5); // (1)
}

FX_FORMULA(fxSoilEase)(FX_REAL u)
{
    return u * u * (FX_REAL(3.0) - FX_REAL(2.0) * u);
}

FX_FORMULA(fxSoilNoise)(FX_REAL x, FX_REAL z)
{
    FX_REAL i = floor(x);
    FX_REAL j = floor(z);
    FX_REAL t = fxSoilEase(x - i);
    FX_REAL near = fxSoilValue(i, j) * (FX_REAL(1.0) - t) + fxSoilValue(i + FX_REAL(1.0), j) * t;
    FX_REAL far = fxSoilValue(i, j + FX_REAL(1.0)) * (FX_REAL(1.0) - t) +
                  fxSoilValue(i + FX_REAL(1.0), j + FX_REAL(1.0)) * t;
    return near + (far - near) * fxSoilEase(z - j); // (2)
}

FX_FORMULA(fxSoilSlopeX)(FX_REAL x, FX_REAL z)
{
    FX_REAL i = floor(x);
    FX_REAL j = floor(z);
    FX_REAL u = x - i;
    FX_REAL near = fxSoilValue(i + FX_REAL(1.0), j) - fxSoilValue(i, j);
    FX_REAL far = fxSoilValue(i + FX_REAL(1.0), j + FX_REAL(1.0)) - fxSoilValue(i, j + FX_REAL(1.0));
    return FX_REAL(6.0) * u * (FX_REAL(1.0) - u) * (near + (far - near) * fxSoilEase(z - j)); // (3)
}

FX_FORMULA(fxSoilSlopeZ)(FX_REAL x, FX_REAL z)
{
    FX_REAL i = floor(x);
    FX_REAL j = floor(z);
    FX_REAL w = z - j;
    FX_REAL left = fxSoilValue(i, j + FX_REAL(1.0)) - fxSoilValue(i, j);
    FX_REAL right = fxSoilValue(i + FX_REAL(1.0), j + FX_REAL(1.0)) - fxSoilValue(i + FX_REAL(1.0), j);
    return FX_REAL(6.0) * w * (FX_REAL(1.0) - w) * (left + (right - left) * fxSoilEase(x - i)); // (4)
}

FX_FORMULA(fxSoilSize)(FX_REAL k)
{
    return FX_REAL(6.0) / pow(FX_REAL(2.5), k); // (5)
}

FX_FORMULA(fxSoilSteepness)(FX_REAL l)
{
    return FX_REAL(0.55) / (FX_REAL(1.0) + l / FX_REAL(0.25)); // (5)
}

FX_FORMULA(fxSoilContrast)(FX_REAL l)
{
    return FX_REAL(0.20) + FX_REAL(0.12) / (FX_REAL(1.0) + l / FX_REAL(0.5)); // (5)
}
