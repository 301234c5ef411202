/// @formula tone-curve
/// Exposed radiance to display light: untouched up to middle gray, then a shoulder like that of film.
///
/// symbol    unit   meaning
///   x       1      exposed radiance of one channel; 1 is what a display shows as white without a curve
///   white   1      radiance that is shown as 1, >= 1
///   g       1      middle gray, 0.18: it is shown as 0.18
///   t, w    1      radiance and white above middle gray in units of the display light that is left
///
/// @derivation
///   t = (x - g) / (1 - g), w = (white - g) / (1 - g)                                              (1)
///   s(t) = t (1 + t / w^2) / (1 + t) has s(0) = 0, s'(0) = 1, s(w) = 1, s' > 0                     (2)
///   y = x for x <= g, g + (1 - g) s(t) above: the slope is 1 from black to middle gray and continuous there
///   (3) x >= white gives 1. Channels are treated alike: a fire of red : green : blue = 1 : 0.3 : 0.03 turns
///   from red-orange to yellow to nearly white as it grows brighter, because red reaches the shoulder first.
/// @source    [RSSF02] eq. (4) for (2)
/// @deviation the paper applies (2) from black on to luminance; here it starts at middle gray and takes each
/// channel
/// @valid     x <= 0 gives 0; x = +inf gives 1; NaN is not accepted
/// @accuracy  float: |error| <= 4e-7, GLSL within 1e-6
/// @tests     tests/rendering/passes/test_tone_map.cpp
FX_FORMULA(fxToneCurve)(FX_REAL x, FX_REAL white)
{
    FX_REAL g = FX_REAL(0.18);
    FX_REAL v = clamp(x, FX_REAL(0.0), white);
    FX_REAL t = max(v - g, FX_REAL(0.0)) / (FX_REAL(1.0) - g);         // (1)
    FX_REAL w = (white - g) / (FX_REAL(1.0) - g);                      // (1)
    FX_REAL s = t * (FX_REAL(1.0) + t / (w * w)) / (FX_REAL(1.0) + t); // (2)
    return min(min(v, g) + (FX_REAL(1.0) - g) * s, FX_REAL(1.0));      // (3)
}

/// @formula srgb-encoding
/// Display light to the code value of sRGB.
///
/// symbol    unit   meaning
///   y       1      display light, [0, 1]
///   code    1      value that is stored, [0, 1]
/// @derivation
///   code = 12.92 y for y <= 0.0031308                                                             (1)
///   code = 1.055 y^(1/2.4) - 0.055 above                                                          (2)
/// @source    [IEC99] IEC 61966-2-1
/// @deviation none
/// @valid     y from 0 to 1
/// @accuracy  float: |error| <= 2e-7; GLSL within 5e-6, because pow() of a GPU is 2^(log2(y) / 2.4)
/// @tests     tests/rendering/passes/test_tone_map.cpp
FX_FORMULA(fxSrgbEncode)(FX_REAL y)
{
    FX_REAL low = FX_REAL(12.92) * y; // (1)
    FX_REAL high =
        FX_REAL(1.055) * pow(max(y, FX_REAL(1e-6)), FX_REAL(0.416666666666667)) - FX_REAL(0.055); // (2)
    return y <= FX_REAL(0.0031308) ? low : high;
}

/// @formula film-crosstalk
/// Share of a pixel's light that its layers or color filters pass to each other: very bright colored light
/// turns pale, as on film and on a sensor, instead of clipping to a pure color.
///
/// symbol    unit   meaning
///   peak    1      largest of the three channels, exposed radiance
///   white   1      radiance that is shown as 1, >= 1
///   k       1      share; the channel becomes x + k (mean - x)
///
/// @derivation
///   k = 0.22 min(peak / white, 1): dim colors stay pure, the brightest lose a fifth of their purity   (1)
///   The mean of the three channels is unchanged for every k.
/// @source    own; a model of the effect, not of one sensor
/// @deviation none
/// @valid     peak <= 0 gives 0; peak = +inf gives 0.22; NaN is not accepted
/// @accuracy  exact up to rounding
/// @tests     tests/rendering/passes/test_tone_map.cpp
FX_FORMULA(fxFilmCrosstalk)(FX_REAL peak, FX_REAL white)
{
    return FX_REAL(0.22) * clamp(peak / white, FX_REAL(0.0), FX_REAL(1.0)); // (1)
}
