/// @formula sphere-path
/// Length of the part of a ray that runs inside a ball and is neither before its start nor behind its end.
///
/// symbol    unit   meaning
///   r       m      radius of the ball, > 0
///   h       m      distance from the center to the ray, >= 0
///   tc      m      ray parameter of the point nearest to the center
///   t0, t1  m      ray parameters where the visible ray begins (near plane) and ends (opaque surface or +inf)
///
/// @derivation
///   The ray is inside where |t - tc| <= w with w = sqrt(r^2 - h^2)                            (1)
///   so that the visible length is max(0, min(t1, tc + w) - max(t0, tc - w))                   (2)
/// @source    [USS06] section 3 for the clipped travel distance; the chord is the exact one along the ray
/// @deviation the paper takes rays parallel to the view axis, which loses a third of the thickness at 45 degrees; (1) is
///            evaluated as sqrt((r - h)(r + h)), which keeps its relative accuracy at the rim
/// @valid     h >= r gives 0; t1 = +inf is no occluder; NaN is not accepted
/// @accuracy  |error| <= 2^-20 (|tc| + r)
/// @tests     tests/rendering/core/test_formulas.cpp
FX_FORMULA(fxSpherePath)(FX_REAL r, FX_REAL h, FX_REAL tc, FX_REAL t0, FX_REAL t1)
{
    FX_REAL w = sqrt(max((r - h) * (r + h), FX_REAL(0.0)));                 // (1)
    return max(min(t1, tc + w) - max(t0, tc - w), FX_REAL(0.0));            // (2)
}

/// @formula uniform-ball-optical-depth
/// Optical depth of a homogeneous ball whose volume holds the extinction cross section sigma.
///
/// symbol    unit   meaning
///   sigma   m2     total extinction cross section, >= 0
///   others         as in sphere-path
/// @derivation
///   Extinction is sigma / (4/3 pi r^3), times the path                                        (1)
/// @source    [USS06] section 3, homogeneous particle
/// @deviation none
/// @valid     as sphere-path
/// @accuracy  relative error of the path plus 4 eps
/// @tests     tests/rendering/core/test_formulas.cpp
FX_FORMULA(fxUniformBallOpticalDepth)(FX_REAL sigma, FX_REAL r, FX_REAL h, FX_REAL tc, FX_REAL t0, FX_REAL t1)
{
    return FX_REAL(0.238732414637843) * sigma / (r * r) * (fxSpherePath(r, h, tc, t0, t1) / r); // (1)
}
