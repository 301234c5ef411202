/// @formula henyey-greenstein
/// Share of scattered light that leaves per solid angle at an angle to its old direction.
///
/// symbol     unit   meaning
///   cosine   1      of the angle between old and new direction, -1..1; 1 is straight on
///   g        1      mean cosine, (-1, 1); 0 is isotropic
///   d        1      squared distance in the ellipse of the phase function, at least (1 - |g|)^2
///   p        1/sr   phase function
/// @derivation p = (1 - g^2) / (4 pi d^(3/2)), d = 1 + g^2 - 2 g cosine                          (1)
/// @source    [HG41] Henyey & Greenstein, doi:10.1086/144246
/// @deviation d is not less than (1 - |g|)^2, which a cosine that rounding has made larger than 1 would give
/// @valid     |g| < 1
/// @accuracy  integrates to 1 over the sphere within 1e-6 for |g| <= 0.9
/// @tests     tests/rendering/core/test_optics.cpp
FX_FORMULA(fxHenyeyGreenstein)(FX_REAL cosine, FX_REAL g)
{
    FX_REAL nearest = FX_REAL(1.0) - abs(g);
    FX_REAL d = max(FX_REAL(1.0) + g * g - FX_REAL(2.0) * g * cosine, nearest * nearest);
    return (FX_REAL(1.0) - g * g) / (FX_REAL(12.566370614359172) * d * sqrt(d)); // (1)
}
