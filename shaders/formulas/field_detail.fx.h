/// @formula field-detail
/// Erodes the summed extinction of a medium by noise: a threshold on its logarithm, so that thin medium falls
/// apart into lumps and dense medium stays whole.
///
/// symbol     unit   meaning
///   k        1/m    extinction of the smooth field
///   l        m      size of the largest lumps
///   t0, t1   1      optical depths of a lump: up to t0 nothing is left, from t1 on all is
///   s        1      place of k between the two, 0 at t0, 1 at t1, by logarithm
///   z        1      noise, mean 0, deviation 1, positive in lumps
///   h        1      threshold, uniform in 0..1
///   w        1      width of the threshold
///   g        1      share that is left at a point
///   m        1      mean of g over h
///   n        1      factor that keeps the mean, at most 6
///   u        1      variance of octaves that have faded out, 0..1; z is the sum of the others
///   q        1      optical depth of a lump of one ball by itself: its extinction in the middle times l
///   v        1      thinning of a medium: mean over its balls, by their extinction
///   a        1      v times the preset's softening
///   T        K      temperature; c its loss at the surface of lumps, b its gain per deviation of the noise
/// @derivation
///   Extinctions of a gas span four decades, so the threshold is on the logarithm:
///       s = ln(k l / t0) / ln(t1 / t0)                                                        (1)
///   The noise is nearly normal; the logistic curve of slope 1.702 is within 0.01 of the normal distribution
///   function, so that
///       h = 1 / (1 + exp(1.702 z))                                                            (2)
///   is nearly uniform, and low in lumps. A ramp instead of a step leaves an edge of width w:
///       g = sat((s - h) / w)                                                                  (3)
///   With P the integral of the ramp, P(x) = 0 | x^2 / (2 w) | x - w / 2 for x < 0 | x < w | x >= w,
///       m = integral of (3) over h = P(s) - P(s - 1)                                          (4)
///       n = min(1 / m, 6)                                                                     (5)
///   keeps the mean extinction where m >= 1/6; what is thinner is lost. n g = 1 for s >= 1 + w.
///   Octaves that are finer than a pixel have no value there, see lump-noise. A threshold is not linear, so the
///   share of their mean is not their mean share: that is lower in lumps and higher in creases. Over a normal
///   deviate of variance u the share has the mean
///       (1/w) integral over x = s - w .. s of p(x), p(x) = 1 / (1 + exp(-(1.702 z + ln(x / (1 - x))) / sqrt(u))) (7)
///   with p = 0 for x <= 0 and 1 for x >= 1: (3) for u = 0, (4) for u = 1 and z = 0. It is summed at three Gauss
///   nodes, and blended with (3) for u < 1/4, where p is steeper than nodes are apart.
///   Gas at the surface of a lump has mixed with air, and creases are deep in it:
///       T' = T (1 - c (1 - sat(2 (s - h))) + b (1 - sat(2 (s - 1 - w))) clamp(z, -1.5, 1.5))    (6)
///   so that T' = T, as k, does not depend on the noise for s >= 3/2 + w: none is needed there.
///   Medium that spreads is mixed with air between its lumps too, first where lumps are small. How far that has
///   gone follows from the depth of the balls, which grow as they take in air:
///       v = max(0, ln(t0^(3/4) t1^(1/4) / q))                                                 (8)
///   The depths t0 and t1 fall by exp(-a), the edges and the noise soften:
///       s' = s + a / ln(t1 / t0)                                                              (9)
///       w' = 1 - (1 - w) exp(-0.25 a)                                                         (10)
///       G' = G exp(-0.15 a), G being the amplitude of an octave over that of the one before   (11)
///   take the place of s, w and G in all of the above. In the middle of a ball s does not change with its
///   size for a = v: lumps keep their form. For a > v it grows up to where the noise is no more: haze.
/// @source    own; (1)-(5) measured by a prototype on the library's explosion. (7) filters a function of noise by
///            the normal distribution of the noise in a pixel, as [HNPN13] section 3 does for colors
/// @deviation none
/// @valid     k >= 0, 0 < t0 < t1, 0 < w <= 1; k = 0 gives s = -1e3
/// @accuracy  float within 1e-5 of double for s, h, g, m, w', G', within 1e-5 relative for v, and within 1e-4 relative for n and T'; GLSL likewise
/// @tests     tests/rendering/core/test_field_detail_formulas.cpp
FX_FORMULA(fxDetailPlace)(FX_REAL k, FX_REAL l, FX_REAL t0, FX_REAL t1)
{
    FX_REAL depth = k * l / t0;
    return depth > FX_REAL(1e-30) ? max(log(depth) / log(t1 / t0), FX_REAL(-1000.0)) : FX_REAL(-1000.0); // (1)
}

FX_FORMULA(fxDetailThreshold)(FX_REAL z)
{
    return FX_REAL(1.0) / (FX_REAL(1.0) + exp(FX_REAL(1.702) * clamp(z, FX_REAL(-40.0), FX_REAL(40.0)))); // (2)
}

FX_FORMULA(fxDetailShare)(FX_REAL s, FX_REAL h, FX_REAL w)
{
    return clamp((s - h) / w, FX_REAL(0.0), FX_REAL(1.0)); // (3)
}

FX_FORMULA(fxDetailPassed)(FX_REAL x, FX_REAL z, FX_REAL u)
{
    FX_REAL inside = clamp(x, FX_REAL(1e-6), FX_REAL(1.0) - FX_REAL(1e-6));
    FX_REAL a = (FX_REAL(1.702) * z + log(inside / (FX_REAL(1.0) - inside))) / sqrt(max(u, FX_REAL(1e-4)));
    FX_REAL p = FX_REAL(1.0) / (FX_REAL(1.0) + exp(clamp(-a, FX_REAL(-80.0), FX_REAL(80.0))));
    return x <= FX_REAL(0.0) ? FX_REAL(0.0) : (x >= FX_REAL(1.0) ? FX_REAL(1.0) : p);
}

FX_FORMULA(fxDetailShareOver)(FX_REAL s, FX_REAL z, FX_REAL u, FX_REAL w)
{
    FX_REAL middle = s - FX_REAL(0.5) * w;
    FX_REAL away = FX_REAL(0.387298334620742) * w;
    FX_REAL mean = (FX_REAL(5.0) * fxDetailPassed(middle - away, z, u) +
                    FX_REAL(8.0) * fxDetailPassed(middle, z, u) +
                    FX_REAL(5.0) * fxDetailPassed(middle + away, z, u)) / FX_REAL(18.0); // (7)
    FX_REAL own = fxDetailShare(s, fxDetailThreshold(z), w);
    return own + clamp(FX_REAL(4.0) * u, FX_REAL(0.0), FX_REAL(1.0)) * (mean - own);
}

FX_FORMULA(fxDetailRamp)(FX_REAL x, FX_REAL w)
{
    FX_REAL inside = clamp(x, FX_REAL(0.0), w);
    return inside * inside / (FX_REAL(2.0) * w) + max(x - w, FX_REAL(0.0));
}

FX_FORMULA(fxDetailMean)(FX_REAL s, FX_REAL w)
{
    return fxDetailRamp(s, w) - fxDetailRamp(s - FX_REAL(1.0), w); // (4)
}

FX_FORMULA(fxDetailGain)(FX_REAL s, FX_REAL w)
{
    return min(FX_REAL(1.0) / max(fxDetailMean(s, w), FX_REAL(1e-6)), FX_REAL(6.0)); // (5)
}

FX_FORMULA(fxDetailTemperature)
(FX_REAL T, FX_REAL s, FX_REAL h, FX_REAL w, FX_REAL z, FX_REAL c, FX_REAL b)
{
    FX_REAL one = FX_REAL(1.0);
    FX_REAL inner = clamp(FX_REAL(2.0) * (s - h), FX_REAL(0.0), one);
    FX_REAL outer = one - clamp(FX_REAL(2.0) * (s - one - w), FX_REAL(0.0), one);
    return T * (one - c * (one - inner) + b * outer * clamp(z, FX_REAL(-1.5), FX_REAL(1.5))); // (6)
}

FX_FORMULA(fxDetailThinning)(FX_REAL q, FX_REAL t0, FX_REAL t1)
{
    FX_REAL least = FX_REAL(0.75) * log(t0) + FX_REAL(0.25) * log(t1);
    return max(least - log(max(q, FX_REAL(1e-12))), FX_REAL(0.0)); // (8)
}

FX_FORMULA(fxDetailSoftPlace)(FX_REAL s, FX_REAL a, FX_REAL t0, FX_REAL t1)
{
    return s + a / log(t1 / t0); // (9)
}

FX_FORMULA(fxDetailSoftRamp)(FX_REAL w, FX_REAL a)
{
    return FX_REAL(1.0) - (FX_REAL(1.0) - w) * exp(FX_REAL(-0.25) * a); // (10)
}

FX_FORMULA(fxDetailSoftGain)(FX_REAL G, FX_REAL a)
{
    return G * exp(FX_REAL(-0.15) * a); // (11)
}
