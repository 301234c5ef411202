/// @formula kernel-optical-depth
/// Optical depth of a blob with the quartic kernel along a ray, cut by the ray's start and end.
///
/// symbol    unit   meaning
///   sigma   m2     extinction cross section of the blob: the integral of its extinction over space, >= 0
///   r       m      radius of the kernel's support, > 0
///   h       m      distance from the center to the ray, >= 0
///   tc      m      ray parameter of the point nearest to the center
///   t0, t1  m      ray parameters where the visible ray begins and ends, t1 may be +inf
///   u       1      ray parameter in units of half the chord, -1..1
///
/// @derivation
///   Extinction at distance s is sigma W(s), W(s) = 105/(32 pi r^3) (1 - (s/r)^2)^2             (1)
///   On the ray s^2 = h^2 + (t - tc)^2. With w^2 = r^2 - h^2 and t = tc + w u                   (2)
///       1 - (s/r)^2 = (w/r)^2 (1 - u^2)
///   so that the integral over [u0, u1] is
///       tau = sigma 105/(32 pi r^2) (w/r)^5 [u - 2 u^3/3 + u^5/5]                              (3)
///   The bracket is 16/15 over the full chord: tau = 3.5/pi sigma/r^2 (w/r)^5.
///   fxKernelPeak is sigma W(0), fxKernelExtinction sigma W(s) of the square of s.
/// @source    [UBT96] eq. (1) for the kernel; the clipped integral is elementary
/// @deviation the paper integrates whole blobs between sorted events; here one blob is cut by its ray
/// @valid     h >= r gives 0; w = 0 gives 0 without a division; t1 = +inf is no occluder
/// @accuracy  |error| <= 2e-6 of the largest value over all rays (float), equal in GLSL within 4e-6
/// @tests     tests/rendering/core/test_formulas.cpp
FX_FORMULA(fxKernelPeak)(FX_REAL sigma, FX_REAL r)
{
    return FX_REAL(1.04445431404056) * sigma / (r * r * r); // (1)
}

FX_FORMULA(fxKernelExtinction)(FX_REAL sigma, FX_REAL r, FX_REAL s2)
{
    FX_REAL q = max(FX_REAL(1.0) - s2 / (r * r), FX_REAL(0.0));
    return fxKernelPeak(sigma, r) * q * q; // (1)
}

FX_FORMULA(fxKernelOpticalDepth)(FX_REAL sigma, FX_REAL r, FX_REAL h, FX_REAL tc, FX_REAL t0, FX_REAL t1)
{
    FX_REAL q2 = max((r - h) * (r + h), FX_REAL(0.0)) / (r * r);
    FX_REAL w = max(sqrt(q2) * r, r * FX_REAL(1e-12)); // (2)
    FX_REAL u0 = clamp((t0 - tc) / w, FX_REAL(-1.0), FX_REAL(1.0));
    FX_REAL u1 = clamp((t1 - tc) / w, FX_REAL(-1.0), FX_REAL(1.0));
    FX_REAL s0 = u0 * u0;
    FX_REAL s1 = u1 * u1;
    FX_REAL f0 = u0 * (FX_REAL(1.0) - s0 * (FX_REAL(0.666666666666667) - s0 * FX_REAL(0.2)));
    FX_REAL f1 = u1 * (FX_REAL(1.0) - s1 * (FX_REAL(0.666666666666667) - s1 * FX_REAL(0.2)));
    FX_REAL q5 = q2 * q2 * sqrt(q2);
    return FX_REAL(1.04445431404056) * sigma / (r * r) * q5 * max(f1 - f0, FX_REAL(0.0)); // (3)
}
