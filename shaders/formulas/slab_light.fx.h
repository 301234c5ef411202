/// @formula slab-light
/// Light that leaves the near face of a slab of medium, from its optical depth, what it emits, and the first moments of both.
///
/// symbol    unit   meaning
///   d       1      optical depth of the slab, >= 0
///   e       any    emitted light, the integral of source times extinction along the slab, >= 0
///   md, me  1,any  the same integrals with the weight x, the place in the slab: -1/2 at the near face, 1/2 at the far one
///   s       any    source in the middle of the slab
///   s1      any    change of the source from the near face to the far one
///
/// @derivation
///   With the source s + s1 x and even extinction the transmittance up to x is exp(-d (x + 1/2)), and the light
///       integral of (s + s1 x) d exp(-d (x + 1/2)) dx = s (1 - a) + s1 ((1 - a)/d - a - (1 - a)/2),  a = exp(-d)     (1)
///   The source is that of the same integrals: e = s d, and me - s md = s1 d/12                                       (2)
///   It is nowhere negative while |s1| <= 2 s                                                                         (3)
///   For small d the bracket of (1) is -d^2/12 + d^3/24 - d^4/80 + ...                                                (4)
///   and with (2), without a quotient, the light is
///       e (1 - d/2 + d^2/6 - d^3/24) - (d me - e md) (1 - d/2 + 3 d^2/20)                                            (5)
///   so that it is a polynomial where d, e or their moments are below 0, as at the rims of voxel-kernel
/// @source    own; (1) is elementary
/// @deviation none
/// @valid     d = 0 gives e: what emits without hiding adds up. fxSlabThinLight: any sign, |d| <= 0.05
/// @accuracy  relative error <= 2e-5 (float) of the light of an even medium with a linear source
/// @tests     tests/rendering/core/test_slab_light.cpp
FX_FORMULA(fxSlabSlope)(FX_REAL d, FX_REAL e, FX_REAL md, FX_REAL me)
{
    FX_REAL depth = max(d, FX_REAL(1e-12));
    FX_REAL s = e / depth;
    FX_REAL s1 = FX_REAL(12.0) * (me - s * md) / depth;                                                               // (2)
    return clamp(s1, FX_REAL(-2.0) * s, FX_REAL(2.0) * s);                                                           // (3)
}

FX_FORMULA(fxSlabOpacity)(FX_REAL d)
{
    return d < FX_REAL(0.05) ? d * (FX_REAL(1.0) - d * (FX_REAL(0.5) - d * (FX_REAL(0.166666666666667) - d * FX_REAL(0.041666666666667))))
                             : FX_REAL(1.0) - exp(-d);
}

FX_FORMULA(fxSlabSlopeWeight)(FX_REAL d)
{
    FX_REAL a = exp(-d);
    FX_REAL exact = (FX_REAL(1.0) - a) / max(d, FX_REAL(1e-3)) - a - FX_REAL(0.5) * (FX_REAL(1.0) - a);                 // (1)
    FX_REAL series = d * d * (FX_REAL(-0.083333333333333) + d * (FX_REAL(0.041666666666667) - d * FX_REAL(0.0125)));    // (4)
    return d < FX_REAL(0.1) ? series : exact;
}

FX_FORMULA(fxSlabLight)(FX_REAL d, FX_REAL e, FX_REAL s1)
{
    FX_REAL depth = max(d, FX_REAL(1e-12));
    FX_REAL even = d > FX_REAL(0.0) ? e / depth * fxSlabOpacity(d) : e;
    return even + s1 * fxSlabSlopeWeight(d);
}

FX_FORMULA(fxSlabThinLight)(FX_REAL d, FX_REAL e, FX_REAL md, FX_REAL me)
{
    FX_REAL one = FX_REAL(1.0);
    FX_REAL even = one - d * (FX_REAL(0.5) - d * (FX_REAL(0.166666666666667) - d * FX_REAL(0.041666666666667)));
    return e * even - (d * me - e * md) * (one - d * (FX_REAL(0.5) - d * FX_REAL(0.15)));                           // (5)
}
