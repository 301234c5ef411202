/// @formula kernel-moment
/// First moment of the optical depth of a blob with the quartic kernel along its chord.
///
/// symbol    unit   meaning
///   u       1      ray parameter in units of half the chord, from its middle, -1..1
///
/// @derivation
///   The share of the optical depth at u has the density 15/16 (1 - u^2)^2, see kernel-quantile                        (1)
///   The integral of u times (1) up to u is -15/96 (1 - u^2)^3, which is 0 at both ends                                (2)
/// @source    own; (2) is elementary
/// @deviation none
/// @valid     -1 <= u <= 1
/// @accuracy  |error| <= 1e-7 (float)
/// @tests     tests/rendering/core/test_slab_light.cpp
FX_FORMULA(fxKernelMoment)(FX_REAL u)
{
    FX_REAL q = FX_REAL(1.0) - u * u;
    return FX_REAL(-0.15625) * q * q * q; // (2)
}
