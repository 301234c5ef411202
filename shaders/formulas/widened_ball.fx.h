/// @formula widened-ball
/// Cross section of a blob that is drawn wider than it is, so that it covers as much as before in the mean.
///
/// symbol    unit   meaning
///   sigma   m2     extinction cross section of the blob, >= 0
///   r       m      radius of the kernel's support, > 0
///   wide    m      radius with which the blob is drawn, >= r
///   t       1      optical depth through the middle
///   F       1      mean opacity over the disc of the blob
///
/// @derivation
///   With kernel-optical-depth, t = 7/(2 pi) sigma/r^2, at distance h depth is t s^(5/2), s = 1 - (h/r)^2
///       F(t) = integral over s in [0, 1] of 1 - exp(-t s^(5/2))                                (1)
///   F = 2/7 t for small t. A fit that is exact there and has an inverse:
///       F(t) = 1 - (1 + 3/7 t)^(-2/3)                                                          (2)
///   The disc grows by (wide/r)^2, so that the opacity over the picture stays where
///       F(t') = F(t) (r/wide)^2 = c, hence 3/7 t' = (1 - c)^(-3/2) - 1                         (3)
///   Without cancellation, with a = 1 + x, x = 3/7 t, u = a^(2/3), y = 1 - c, v = y^(-3/2):
///       F = (u - 1)/u, u - 1 = x (2 + x)/(u^2 + u + 1)                                         (4)
///       v - 1 = c (3 - 3 c + c^2)/(y^3 (v + 1))                                                (5)
/// @source    own
/// @deviation an optically thick blob whose cross section is kept covers too much once it is widened: 2.7
///            times as much at t = 5
/// @valid     wide < r counts as r; t above 1e9 as 1e9, where F is 1 within 1e-6; wide^2 must not underflow
/// @accuracy  F within 7.5 % of (1) for any t, the opacity over the picture within 11 %; float within 5e-6 of double
/// @tests     tests/rendering/core/test_widened_ball.cpp
FX_FORMULA(fxBallCover)(FX_REAL t)
{
    FX_REAL x = FX_REAL(0.428571428571429) * t;
    FX_REAL a = FX_REAL(1.0) + x;
    FX_REAL u = pow(a, FX_REAL(0.666666666666667));
    return x * (FX_REAL(2.0) + x) / (u * u + u + FX_REAL(1.0)) / u; // (4)
}

FX_FORMULA(fxWidenedSection)(FX_REAL sigma, FX_REAL r, FX_REAL wide)
{
    FX_REAL shrink = min(r / wide, FX_REAL(1.0));
    FX_REAL t = min(FX_REAL(1.11408460164327) * sigma / max(r * r, FX_REAL(1e-37)), FX_REAL(1e9));
    FX_REAL c = fxBallCover(t) * shrink * shrink;
    FX_REAL y = FX_REAL(1.0) - c;
    FX_REAL y3 = y * y * y;
    FX_REAL v = FX_REAL(1.0) / sqrt(y3);
    FX_REAL x = c * (FX_REAL(3.0) - c * (FX_REAL(3.0) - c)) / (y3 * (v + FX_REAL(1.0))); // (5)
    FX_REAL section = FX_REAL(2.0943951023932) * x * wide * wide;                        // (3)
    return wide > r ? section : sigma;
}
