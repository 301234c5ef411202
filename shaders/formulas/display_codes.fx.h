/// @formula tone-curve-inverse
/// Display light to the exposed radiance that the tone curve shows as this light.
///
/// symbol    unit   meaning
///   y       1      display light, [0, 1]
///   white   1      radiance that is shown as 1, >= 1
///   g       1      middle gray, 0.18
///   s, w    1      light and white above middle gray in units of the display light that is left
///   t       1      radiance above middle gray in the same units
///
/// @derivation
///   Formula tone-curve has s = t (1 + t / w^2) / (1 + t) with s = (y - g) / (1 - g)                (1)
///   Its positive solution is t = 2 s / ((1 - s) + sqrt((1 - s)^2 + 4 s / w^2)), without a difference
///   of nearly equal numbers; s = 1 gives t = w, and w = 1 gives t = s                             (2)
///   x = y for y <= g, g + (1 - g) t above                                                         (3)
/// @source    own; inverse of [RSSF02] eq. (4)
/// @deviation none
/// @valid     y <= 0 gives 0, y >= 1 gives white; NaN is not accepted
/// @accuracy  fxToneCurve() of the result is y within 4e-7 in float; GLSL within 1e-6
/// @tests     tests/rendering/passes/test_display_codes.cpp
FX_FORMULA(fxToneCurveInverse)(FX_REAL y, FX_REAL white)
{
    FX_REAL g = FX_REAL(0.18);
    FX_REAL v = clamp(y, FX_REAL(0.0), FX_REAL(1.0));
    FX_REAL s = max(v - g, FX_REAL(0.0)) / (FX_REAL(1.0) - g); // (1)
    FX_REAL w = (white - g) / (FX_REAL(1.0) - g);              // (1)
    FX_REAL r = FX_REAL(1.0) - s;
    FX_REAL t = FX_REAL(2.0) * s / (r + sqrt(r * r + FX_REAL(4.0) * s / (w * w))); // (2)
    return min(min(v, g) + (FX_REAL(1.0) - g) * t, white);                         // (3)
}

/// @formula display-composite
/// Effects over a pixel of a picture that was drawn for a display: one channel of exposed radiance whose tone
/// curve is the new pixel.
///
/// symbol      unit   meaning
///   y         1      display light of the pixel, [0, 1]
///   light     1      exposed radiance of the effects, >= 0
///   share     1      part of the light behind that effects let through, [0, 1]
///   hostWhite 1      exposed radiance that the host has drawn as 1, from 1 to white
///   white     1      exposed radiance of effects that is shown as 1, >= 1
///   b, c      1      exposed radiance behind, attenuated, and display light that the host would draw for it
///   H, h      1      display light of b with and without the effects, by the curve of the effects
///
/// @derivation
///   The pixel stands for the radiance that the host's curve shows as y: b = share curve^-1(y)      (1)
///   Without light of its own, the effect shows c = curve(b) with the host's white                  (2)
///   Light is added along the curve of the effects and fills the share of display light that is
///   left: out = c + (1 - c) (H - h) / (1 - h). It is y for light 0 and share 1, curve(light) over
///   black, at most 1, and curve(b + light) if both whites are equal                                (3)
///   The result is curve^-1(out), and what exceeds white, which glare distributes                   (4)
/// @source    own
/// @deviation none
/// @valid     hostWhite <= white; NaN is not accepted
/// @accuracy  its tone curve is within 4e-6 of the one in double
/// @tests     tests/rendering/passes/test_display_codes.cpp
FX_FORMULA(fxDisplayComposite)(FX_REAL y, FX_REAL light, FX_REAL share, FX_REAL hostWhite, FX_REAL white)
{
    FX_REAL one = FX_REAL(1.0);
    FX_REAL b = share * fxToneCurveInverse(y, hostWhite); // (1)
    FX_REAL c = fxToneCurve(b, hostWhite);                // (2)
    FX_REAL h = fxToneCurve(b, white);
    FX_REAL added = (fxToneCurve(b + light, white) - h) / max(one - h, FX_REAL(1e-6));
    FX_REAL shown = c + (one - c) * min(added, one);                                        // (3)
    return fxToneCurveInverse(shown, white) + max(b + light - white, FX_REAL(0.0)); // (4)
}

/// @formula srgb-decoding
/// Code value of sRGB to display light.
///
/// symbol    unit   meaning
///   code    1      value that is stored, [0, 1]
///   y       1      display light, [0, 1]
/// @derivation
///   y = code / 12.92 for code <= 0.04045                                                          (1)
///   y = ((code + 0.055) / 1.055)^2.4 above                                                        (2)
/// @source    [IEC99] IEC 61966-2-1
/// @deviation none
/// @valid     code from 0 to 1
/// @accuracy  float: |error| <= 4e-7; GLSL within 2e-6
/// @tests     tests/rendering/passes/test_display_codes.cpp
FX_FORMULA(fxSrgbDecode)(FX_REAL code)
{
    FX_REAL low = code / FX_REAL(12.92);                                                            // (1)
    FX_REAL high = pow((max(code, FX_REAL(0.04)) + FX_REAL(0.055)) / FX_REAL(1.055), FX_REAL(2.4)); // (2)
    return code <= FX_REAL(0.04045) ? low : high;
}

/// @formula gamma-encoding
/// Display light to the code value of a display with a gamma of 2.2.
///
/// symbol    unit   meaning
///   y       1      display light, [0, 1]
///   code    1      value that is stored, [0, 1]
/// @derivation
///   code = y^(1/2.2)                                                                              (1)
/// @source    textbook
/// @deviation y = 0 is a case of its own, because pow() of a GPU is 2^(log2(y) / 2.2)
/// @valid     y from 0 to 1
/// @accuracy  float: |error| <= 2e-7; GLSL within 5e-6
/// @tests     tests/rendering/passes/test_display_codes.cpp
FX_FORMULA(fxGammaEncode)(FX_REAL y)
{
    return y > FX_REAL(0.0) ? pow(max(y, FX_REAL(1e-30)), FX_REAL(0.454545454545455)) : FX_REAL(0.0); // (1)
}

/// @formula gamma-decoding
/// Code value of a display with a gamma of 2.2 to display light.
///
/// symbol    unit   meaning
///   code    1      value that is stored, [0, 1]
///   y       1      display light, [0, 1]
/// @derivation
///   y = code^2.2                                                                                  (1)
/// @source    textbook
/// @deviation code = 0 is a case of its own, as of gamma-encoding
/// @valid     code from 0 to 1
/// @accuracy  float: |error| <= 4e-7; GLSL within 2e-6
/// @tests     tests/rendering/passes/test_display_codes.cpp
FX_FORMULA(fxGammaDecode)(FX_REAL code)
{
    return code > FX_REAL(0.0) ? pow(max(code, FX_REAL(1e-15)), FX_REAL(2.2)) : FX_REAL(0.0); // (1)
}
