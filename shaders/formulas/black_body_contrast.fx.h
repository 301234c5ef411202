/// @formula black-body-contrast
/// Exponent of temperature in the luminance of a black body, so that small
///          temperature differences inside a blob can be applied to a color that was computed once for the
///          blob.
///
/// symbol    unit   meaning
///   T       K      temperature, > 0
///   k       1      d ln L / d ln T
/// @derivation
///   At one wavelength lambda Wien's law gives L ~ exp(-c2 / (lambda T)), hence k = c2 / (lambda T)   (1)
///   with c2 = 0.014388 m K and lambda = 580 nm, where the eye sees most of a fire's light.
/// @source    [Pla01] Wien limit of Planck's law; c2 from CODATA
/// @deviation one wavelength instead of the luminous integral
/// @valid     T from 800 to 4000 K; T <= 1 is treated as 1
/// @accuracy  within 8 % of the slope of the integrated luminance from 1000 to 3000 K
/// @tests     tests/rendering/core/test_optics.cpp
FX_FORMULA(fxBlackBodyContrast)(FX_REAL T)
{
    return FX_REAL(24807.0) / max(T, FX_REAL(1.0)); // (1)
}
