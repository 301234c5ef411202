/// @formula sensor-law
/// Glare of a sensor as a function of the light above the saturation of its pixels.
///
/// symbol    unit   meaning
///   over    1      mean overflow per pixel in units of the saturation value, >= 0
///   A, B, C 1      measured constants of the sensor, C >= 0
///   gain    1      glare per overflow
///   f       1      glare per pixel in units of the saturation value
///
/// @derivation
///   f(over) = over gain, gain = A + B exp(-C over)                                              (1)
///   With u = C over, df/dover = A + B (1 - u) exp(-u). The minimum of (1 - u) exp(-u) over u >= 0 is
///   -exp(-2) at u = 2, its maximum is 1 at u = 0, so that f never falls if and only if
///       A >= B exp(-2) for B > 0,   A >= -B for B < 0,   A >= 0 for B = 0                       (2)
///   checkSensorLaw() refuses what breaks (2): brighter light would give less glare.
/// @source    [UBT96] dazzle of the CCD sensor
/// @deviation over is a mean per pixel, so that A, B and C do not depend on the resolution; the dazzle
/// itself, on GPU
///            and CPU, evaluates (1) in double with an exp() of its own, see dazzle_budget.comp.glsl
/// @valid     over >= 0; C over may overflow to +inf, where gain is A
/// @accuracy  float: relative error of gain <= 2^-20 when A, B >= 0; exactly A when B = 0; the dazzle's own:
///            (4 + C over) 2^-52, GLSL bit for bit
/// @tests     tests/rendering/reference/dazzle/test_dazzle_reference.cpp
FX_FORMULA(fxSensorGain)(FX_REAL over, FX_REAL A, FX_REAL B, FX_REAL C)
{
    return A + B * exp(-C * over); // (1)
}
