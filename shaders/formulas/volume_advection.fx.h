/// @formula volume-advection
/// The medium at a moment between two volumes that have velocities.
///
/// symbol   unit     meaning
///   x      voxel    place
///   s, u   s        time since the first volume, and until the second; w = s / (s + u)
///   g      1/m      weight of the velocity of a voxel: its extinction, but at least 1e-6, so that velocities
///                   that were spread into voxels without medium count where there is nothing else
///   m, e   *        weight times velocity, and weight, interpolated from voxels
///   o      voxel/s  velocity where there are no voxels
///   d      1/s      divergence of the velocity
///   q      1        factor by which lengths grow
///   k      1/m      extinction of both volumes at a and b, each with its factor of (5)
///   S      cd/m2    source function: emitted light over extinction
///   r      1/s      change of ln S of the medium that moves through a place; 0 also: not known
///
/// @derivation
///   The velocity of the medium at x is about that of both volumes there, each with its weight:
///       v(x) = ((1 - w) m1(x) + w m2(x)) / ((1 - w) e1(x) + w e2(x))                            (1)
///   Medium that keeps its velocity comes from the place a in the first volume for which
///       x = a + s v1(a): one step of a fixed-point iteration gives a = x - s v1(x - s v(x))     (2)
///   and goes to the place b in the second volume, likewise
///       b = x + u v2(x + u v(x))                                                               (3)
///   where v1 = m1 / e1, v2 = m2 / e2, and v(x) where they are not defined. If the medium expands alike in
///   all directions, grad v = d/3, a length grows by dx/da = q and a volume by its cube:
///       q = 1 + s d1(a) / 3,  for the second volume  q = 1 - u d2(b) / 3                        (4)
///   within 0.8 to 1.25. The extinction and the scattering coefficient are
///       (1 - w) f1(a) / q1^3 + w f2(b) / q2^3                                                  (5)
///   As a and b lie between voxels, linear interpolation would blur surfaces again, so that fire shows
///   through the soot before it. Extinction and emitted light are shifted by the second order scheme of
///   [VL77] along x, then y, then z, which keeps sums over voxels that all move alike: with the values v of
///   four voxels in a row, at the share t of the way from the second to the third
///       (1 - t) v1 + t v2 + t (1 - t) / 2 (D1 - D2)                                            (9)
///       D1 = the smallest of (v2 - v0)/2, 2 (v1 - v0), 2 (v2 - v1), or 0 if their signs differ;
///       D2 likewise of v1, v2, v3                                                              (10)
///   This is within v1 and v2. S is kept within that of the eight voxels around. Albedo is that of linear
///   interpolation.
///   Emitted light is a steep function of the temperature T: that of a black body is about as T^n with n from
///   12 at 2000 K to 25 at 1000 K in visible light; n = 16 is taken. Matter that cools as it radiates loses
///   heat as T^4, dT/dt = -c T^4, so that T^-3 grows evenly with time. So the source function of the moment
///   is a mean of its powers -3/16
///       S^(-3/16) = (k1 S1(a)^(-3/16) + k2 S2(b)^(-3/16)) / (k1 + k2)                          (6)
///   where the smaller one counts as 1e-10 of the larger one at least, and the emitted light
///       (k1 + k2) S                                                                           (7)
///   If a volume knows r, matter may burn between both, and get hotter and colder again. Then, as of balls
///   (played-balls), S^(1/16) is the cubic polynomial of Hermite with the share p = k2 / (k1 + k2),
///       q = S^(1/16),  c = (s + u) r q / 16 within 3 |q2 - q1| + max(q1, q2)/8
///       q(p) = q1 + p (q2 - q1) + p (1 - p) ((1 - p) (c1 - q2 + q1) - p (c2 - q2 + q1))       (8)
///   The rate of a place is the mean of its voxels, weighted with the sum of the components of their light.
///   At w = 0 and w = 1 they are those of the volume itself.
/// @source    [Stam99] section 2.2 for tracing places back through a flow; [VL77] for (9) and (10); the rest is
///            own
/// @deviation places are traced with the velocity that the medium has in its own volume, not with a flow of
///            the moment between
/// @valid     s |grad v| < 1. Medium is not seen where neither volume has voxels
/// @accuracy  a medium with the flow x/t has its places up to (s/t)^2 of the way, and its density with them;
///            luminance halfway between temperatures that differ by 15 %, of matter that radiates: 6 % from
///            1500 K to 3000 K, 20 % at 1000 K
/// @tests     tests/rendering/volumes/test_volume_moment.cpp
FX_FORMULA(fxFlowWeight)(FX_REAL extinction)
{
    return max(extinction, FX_REAL(1e-6)); // g
}

FX_FORMULA(fxFlowVelocity)(FX_REAL m, FX_REAL e, FX_REAL o)
{
    return e > FX_REAL(1e-20) ? m / e : o; // (1)
}

FX_FORMULA(fxFlowDensity)(FX_REAL seconds, FX_REAL d)
{
    FX_REAL q = clamp(FX_REAL(1.0) + seconds * d / FX_REAL(3.0), FX_REAL(0.8), FX_REAL(1.25)); // (4)
    return FX_REAL(1.0) / (q * q * q);
}

/// (10) of the voxel with the value b
FX_FORMULA(fxFlowSlope)(FX_REAL a, FX_REAL b, FX_REAL c)
{
    FX_REAL left = b - a, right = c - b;
    FX_REAL least = min(abs(left + right) / FX_REAL(2.0), FX_REAL(2.0) * min(abs(left), abs(right)));
    return left * right > FX_REAL(0.0) ? (left > FX_REAL(0.0) ? least : -least) : FX_REAL(0.0);
}

/// (9)
FX_FORMULA(fxFlowShift)(FX_REAL v0, FX_REAL v1, FX_REAL v2, FX_REAL v3, FX_REAL t)
{
    FX_REAL change = (fxFlowSlope(v0, v1, v2) - fxFlowSlope(v1, v2, v3)) / FX_REAL(2.0);
    FX_REAL u = FX_REAL(1.0) - t;
    return u * v1 + t * v2 + t * u * change;
}

/// x^(-3/16)
FX_FORMULA(fxCoolness)(FX_REAL x)
{
    FX_REAL root = sqrt(sqrt(sqrt(sqrt(x))));
    return FX_REAL(1.0) / (root * root * root);
}

/// The inverse of fxCoolness(): x^(-16/3)
FX_FORMULA(fxGlow)(FX_REAL x)
{
    FX_REAL root = pow(x, FX_REAL(-0.333333333333333));
    root *= (FX_REAL(4.0) - x * root * root * root) / FX_REAL(3.0); // pow() of a GPU is less exact
    FX_REAL square = root * root;
    FX_REAL eighth = square * square * square * square;
    return eighth * eighth;
}

/// Light of matter with known rates, over that of q = 1.  @param c1, c2 (s + u) r / 16
FX_FORMULA(fxFlowGlow)(FX_REAL first, FX_REAL second, FX_REAL c1, FX_REAL c2, FX_REAL p)
{
    FX_REAL q1 = sqrt(sqrt(sqrt(sqrt(first)))), q2 = sqrt(sqrt(sqrt(sqrt(second))));
    FX_REAL way = q2 - q1;
    FX_REAL most = FX_REAL(3.0) * abs(way) + max(q1, q2) / FX_REAL(8.0);
    FX_REAL start = clamp(c1 * q1, -most, most), end = clamp(c2 * q2, -most, most);
    FX_REAL u = FX_REAL(1.0) - p;
    FX_REAL q = max(q1 + p * way + p * u * (u * (start - way) - p * (end - way)), FX_REAL(0.0)); // (8)
    FX_REAL square = q * q;
    FX_REAL eighth = square * square * square * square;
    return eighth * eighth;
}

/// @param k1, k2 extinction with their factors  @param j1, j2 emitted light, and e1, e2 extinction, without
/// @param c1, c2 (s + u) r / 16
FX_FORMULA(fxFlowLight)(FX_REAL k1, FX_REAL j1, FX_REAL k2, FX_REAL j2, FX_REAL e1, FX_REAL e2, FX_REAL c1, FX_REAL c2)
{
    const FX_REAL zero = FX_REAL(0.0);
    FX_REAL first = e1 > zero ? max(j1, zero) / e1 : zero; // S1
    FX_REAL second = e2 > zero ? max(j2, zero) / e2 : zero;
    if (!(k2 > zero))
        return e1 > zero ? k1 / e1 * max(j1, zero) : zero; // alone it keeps its own light
    if (!(k1 > zero))
        return e2 > zero ? k2 / e2 * max(j2, zero) : zero;
    FX_REAL most = max(first, second);
    FX_REAL least = most * FX_REAL(1e-10);
    if (!(least > zero))
        return zero;
    if (c1 != zero || c2 != zero)
        return (k1 + k2) * most * fxFlowGlow(max(first, least) / most, max(second, least) / most, c1, c2, k2 / (k1 + k2));
    FX_REAL coolness = (k1 * fxCoolness(max(first, least) / most) + k2 * fxCoolness(max(second, least) / most)) / (k1 + k2); // (6)
    return (k1 + k2) * most * fxGlow(coolness); // (7)
}
