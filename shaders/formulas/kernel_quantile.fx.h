/// @formula kernel-quantile
/// Where on its chord a ray has passed a given share of the optical depth of a blob with the quartic kernel.
///
/// symbol    unit   meaning
///   f       1      share of the optical depth of the whole chord, 0..1
///   u       1      ray parameter in units of half the chord, -1..1
///
/// @derivation
///   The share that is passed at u is F(u) = 1/2 + 15/16 (u - 2 u^3/3 + u^5/5)                  (1)
///   Near an end 1 - F = 5/4 (1 - |u|)^3 + ..., near the middle F = 1/2 + 15/16 u               (2)
///   Two steps of Newton's method on (1) from a blend of both.                                  (3)
/// @source    own; (1) is the normalized integral of kernel-optical-depth
/// @deviation none
/// @valid     any f; it is clamped to [0, 1]
/// @accuracy  |F(u) - f| <= 1e-6 (double)
/// @tests     tests/rendering/core/test_formulas.cpp
FX_FORMULA(fxKernelPassed)(FX_REAL u)
{
    FX_REAL s = u * u;
    return FX_REAL(0.5) + FX_REAL(0.9375) * u * (FX_REAL(1.0) - s * (FX_REAL(0.666666666666667) - s * FX_REAL(0.2))); // (1)
}

FX_FORMULA(fxKernelQuantileStep)(FX_REAL u, FX_REAL halfShare)
{
    FX_REAL q = FX_REAL(1.0) - u * u;
    FX_REAL slope = max(FX_REAL(0.9375) * q * q, FX_REAL(1e-3));
    return clamp(u - (fxKernelPassed(u) - FX_REAL(0.5) - halfShare) / slope, FX_REAL(0.0), FX_REAL(1.0)); // (3)
}

FX_FORMULA(fxKernelQuantile)(FX_REAL f)
{
    FX_REAL x = clamp(FX_REAL(2.0) * f - FX_REAL(1.0), FX_REAL(-1.0), FX_REAL(1.0));
    FX_REAL a = abs(x);
    FX_REAL middle = FX_REAL(0.533333333333333) * a;
    FX_REAL end = FX_REAL(1.0) - pow(max(FX_REAL(0.4) * (FX_REAL(1.0) - a), FX_REAL(1e-12)), FX_REAL(0.333333333333333)); // (2)
    FX_REAL u = middle + (end - middle) * a * a;
    u = fxKernelQuantileStep(fxKernelQuantileStep(u, FX_REAL(0.5) * a), FX_REAL(0.5) * a);
    return x < FX_REAL(0.0) ? -u : u;
}
