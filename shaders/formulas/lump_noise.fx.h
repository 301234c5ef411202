/// @formula lump-noise
/// Noise that looks like the surface of a billowing cloud: round lumps with sharp creases between them.
///
/// symbol    unit   meaning
///   d2      1      square of the distance to the nearest feature point, in cells; cells have one point each
///   q       1      gradient noise in the same cells
///   x, y, z 1      position in cells
///   l, p    m      size of a lump of an octave, width of a pixel there
///   C       1      correlation of B at two places; c its mean between the middle of a pixel and all of the pixel
///   z0, z1  1      fields of two generations of coordinates, each of mean 0 and deviation 1
///   f       1      weight of the second, 0..1
/// @derivation
///   Cellular noise is a paraboloid around each point, with creases where two meet; the magnitude of
///   gradient noise adds furrows that follow no cell:
///       B = 0.65 sat(1 - d2) + 0.35 sat(1.6 |q|)                                              (1)
///   Each octave turns and shifts the one before, and is 2.03 times as fine, so that lattices do not meet:
///       a turn about y by 36.8 degrees, a shift, a turn about x by 36.9 degrees               (2)
///   A ray sees the noise at the middle of its pixel. Given that value, the best estimate of the values in the
///   rest of the pixel is the value times their correlation, and the mean over the pixel is the value times c.
///   So an octave fades out as c falls, and the variance 1 - c^2 is that of what is not seen:
///       r = p^2 / l^2, c = 1 / (1 + r (0.86 + 0.07 r)), band = max(0, 1.05 c - 0.05)          (3)
///   The band is 0.80 for two pixels a lump, 0.5 for one, and 0 below 0.29.
///   Fields that are independent keep deviation 1 when they are blended by
///       z = ((1 - f) z0 + f z1) / sqrt((1 - f)^2 + f^2)                                       (4)
///   and what has faded out of them, of variance u0 and u1, has the variance
///       u = ((1 - f)^2 u0 + f^2 u1) / ((1 - f)^2 + f^2)                                       (5)
///   Billows of one size look like grains. Below the octaves lie broad lumps, 2.6 times as large as the
///   largest of them and 0.8 times as strong, read from the same lattice at
///       x / 2.6 + 5.3 along each axis                                                         (6)
/// @source    [WOR96] cellular noise; [PER02] gradient noise; the mix is own. (3) is linear regression; its numbers
///            are fitted by FieldDetail.theBandIsTheMeanCorrelationOverAPixel, residual 0.03
/// @deviation none
/// @valid     d2 >= 0, p > 0, 0 <= f <= 1
/// @accuracy  GLSL and C++ agree within 1e-5 of (1), (3), (4) and within 1e-6 of |x| + |y| + |z| + 8 of (2)
/// @tests     tests/rendering/core/test_field_detail_formulas.cpp, tests/rendering/core/test_field_detail.cpp
FX_FORMULA(fxLump)(FX_REAL d2, FX_REAL q)
{
    FX_REAL zero = FX_REAL(0.0);
    FX_REAL one = FX_REAL(1.0);
    return FX_REAL(0.65) * clamp(one - d2, zero, one) +
           FX_REAL(0.35) * clamp(FX_REAL(1.6) * abs(q), zero, one); // (1)
}

FX_FORMULA(fxNextOctaveX)(FX_REAL x, FX_REAL z)
{
    return FX_REAL(1.62) * x - FX_REAL(1.21) * z + FX_REAL(3.1); // (2)
}

FX_FORMULA(fxNextOctaveY)(FX_REAL x, FX_REAL y, FX_REAL z)
{
    FX_REAL turned = FX_REAL(1.21) * x + FX_REAL(1.62) * z + FX_REAL(4.4);
    return FX_REAL(0.8) * (FX_REAL(2.03) * y + FX_REAL(1.7)) - FX_REAL(0.6) * turned; // (2)
}

FX_FORMULA(fxNextOctaveZ)(FX_REAL x, FX_REAL y, FX_REAL z)
{
    FX_REAL turned = FX_REAL(1.21) * x + FX_REAL(1.62) * z + FX_REAL(4.4);
    return FX_REAL(0.6) * (FX_REAL(2.03) * y + FX_REAL(1.7)) + FX_REAL(0.8) * turned; // (2)
}

FX_FORMULA(fxOctaveBand)(FX_REAL l, FX_REAL p)
{
    FX_REAL r = p * p / (l * l);
    FX_REAL c = FX_REAL(1.0) / (FX_REAL(1.0) + r * (FX_REAL(0.86) + FX_REAL(0.07) * r));
    return max(FX_REAL(1.05) * c - FX_REAL(0.05), FX_REAL(0.0)); // (3)
}

FX_FORMULA(fxBroadSize)()
{
    return FX_REAL(2.6); // (6)
}

FX_FORMULA(fxBroadAmplitude)()
{
    return FX_REAL(0.8); // (6)
}

FX_FORMULA(fxBroadPlace)(FX_REAL x)
{
    return x / fxBroadSize() + FX_REAL(5.3); // (6)
}

FX_FORMULA(fxBlendGenerations)(FX_REAL z0, FX_REAL z1, FX_REAL f)
{
    FX_REAL e = FX_REAL(1.0) - f;
    return (e * z0 + f * z1) / sqrt(e * e + f * f); // (4)
}

FX_FORMULA(fxBlendFaded)(FX_REAL u0, FX_REAL u1, FX_REAL f)
{
    FX_REAL e = FX_REAL(1.0) - f;
    return (e * e * u0 + f * f * u1) / (e * e + f * f); // (5)
}
