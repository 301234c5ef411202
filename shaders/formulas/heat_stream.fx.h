/// @formula heat-stream
/// Direction and size of the deflection of light by one ball of hot gas with turbulent eddies.
///
/// symbol    unit   meaning
///   x, y    1      position across the ray relative to the ball's center, in radii; y rises with the gas
///   q       1      x^2 + y^2, inside the ball when below 1
///   phase   1      time in periods of the motion, [0, 1)
///   seed    1      of the ball, [0, 1)
///   c       1      column of the quartic kernel along the ray, 1 through the center
///   psi     1      eddies, |psi| <= 1
///   S       1      stream function
///
/// @derivation
///   The column of the kernel (1 - r^2)^2 along the ray is proportional to c = (1 - q)^(5/2)          (1)
///   Eddies are waves w of period 1 that move along their wave vectors k (periods a radius), by whole numbers
///   m of periods while the phase runs through 1, so that phase 0 and 1 are the same:
///       psi = sum a w(kx x + ky y - m phase + m seed)                                                (2)
///   The deflection is the curl of S = c psi, (dS/dy, -dS/dx). It has no divergence, so that the picture is
///   moved but not thinned, and it is 0 at the rim:
///       dS/dx = psi dc/dx + c dpsi/dx,  dc/dx = -5 x (1 - q)^(3/2)                                   (3)
///   w is fxNoiseWave, p(s) = 16 s (1/2 - |s|) on [-1/2, 1/2), whose slope is 8 - 32 |s|              (4)
/// @source    own; [USS06] section 5 for displacing the picture by the heat of particles
/// @deviation the paper takes offsets from a video of noise, scaled by the particle's emission
/// @valid     q >= 1 gives 0; phase + seed < 16 in float
/// @accuracy  the slopes agree with differences of S within 2e-3; GLSL and C++ within 1e-4
/// @tests     tests/rendering/passes/test_heat_offset.cpp
FX_FORMULA(fxHeatWaveSlope)(FX_REAL a)
{
    return FX_REAL(8.0) - FX_REAL(32.0) * abs(fract(a) - FX_REAL(0.5)); // (4)
}

FX_FORMULA(fxHeatArgument)
(FX_REAL kx, FX_REAL ky, FX_REAL m, FX_REAL x, FX_REAL y, FX_REAL phase, FX_REAL seed)
{
    return kx * x + ky * y - fract(m * phase) + fract(m * seed);
}

FX_FORMULA(fxHeatArgument1)(FX_REAL x, FX_REAL y, FX_REAL phase, FX_REAL seed)
{
    return fxHeatArgument(FX_REAL(0.9), FX_REAL(1.3), FX_REAL(9.0), x, y, phase, seed);
}

FX_FORMULA(fxHeatArgument2)(FX_REAL x, FX_REAL y, FX_REAL phase, FX_REAL seed)
{
    return fxHeatArgument(FX_REAL(-1.4), FX_REAL(1.7), FX_REAL(14.0), x, y, phase, seed);
}

FX_FORMULA(fxHeatArgument3)(FX_REAL x, FX_REAL y, FX_REAL phase, FX_REAL seed)
{
    return fxHeatArgument(FX_REAL(2.3), FX_REAL(1.1), FX_REAL(19.0), x, y, phase, seed);
}

FX_FORMULA(fxHeatArgument4)(FX_REAL x, FX_REAL y, FX_REAL phase, FX_REAL seed)
{
    return fxHeatArgument(FX_REAL(-0.5), FX_REAL(2.9), FX_REAL(23.0), x, y, phase, seed);
}

FX_FORMULA(fxHeatEddies)(FX_REAL x, FX_REAL y, FX_REAL phase, FX_REAL seed)
{
    return FX_REAL(0.4) * fxNoiseWave(fxHeatArgument1(x, y, phase, seed)) +
           FX_REAL(0.3) * fxNoiseWave(fxHeatArgument2(x, y, phase, seed)) +
           FX_REAL(0.15) * fxNoiseWave(fxHeatArgument3(x, y, phase, seed)) +
           FX_REAL(0.15) * fxNoiseWave(fxHeatArgument4(x, y, phase, seed)); // (2)
}

FX_FORMULA(fxHeatColumn)(FX_REAL q)
{
    FX_REAL p = max(FX_REAL(1.0) - q, FX_REAL(0.0));
    return p * p * sqrt(p); // (1)
}

FX_FORMULA(fxHeatColumnSlope)(FX_REAL x, FX_REAL q)
{
    FX_REAL p = max(FX_REAL(1.0) - q, FX_REAL(0.0));
    return FX_REAL(-5.0) * x * p * sqrt(p); // (3)
}

FX_FORMULA(fxHeatStreamX)(FX_REAL x, FX_REAL y, FX_REAL phase, FX_REAL seed)
{
    FX_REAL q = x * x + y * y;
    FX_REAL slope = FX_REAL(0.36) * fxHeatWaveSlope(fxHeatArgument1(x, y, phase, seed)) -
                    FX_REAL(0.42) * fxHeatWaveSlope(fxHeatArgument2(x, y, phase, seed)) +
                    FX_REAL(0.345) * fxHeatWaveSlope(fxHeatArgument3(x, y, phase, seed)) -
                    FX_REAL(0.075) * fxHeatWaveSlope(fxHeatArgument4(x, y, phase, seed));
    return fxHeatEddies(x, y, phase, seed) * fxHeatColumnSlope(x, q) + fxHeatColumn(q) * slope; // (3)
}

FX_FORMULA(fxHeatStreamY)(FX_REAL x, FX_REAL y, FX_REAL phase, FX_REAL seed)
{
    FX_REAL q = x * x + y * y;
    FX_REAL slope = FX_REAL(0.52) * fxHeatWaveSlope(fxHeatArgument1(x, y, phase, seed)) +
                    FX_REAL(0.51) * fxHeatWaveSlope(fxHeatArgument2(x, y, phase, seed)) +
                    FX_REAL(0.165) * fxHeatWaveSlope(fxHeatArgument3(x, y, phase, seed)) +
                    FX_REAL(0.435) * fxHeatWaveSlope(fxHeatArgument4(x, y, phase, seed));
    return fxHeatEddies(x, y, phase, seed) * fxHeatColumnSlope(y, q) + fxHeatColumn(q) * slope; // (3)
}

/// @formula heat-refraction
/// Angle by which a ball of hot air deflects light, divided by the curl of its stream function.
///
/// symbol    unit   meaning
///   heat    K      temperature above that of the surrounding air, T0 = 293.15 K, >= 0
///   share   1      air that the heat has driven out, [0, 1)
///   angle   rad    deflection by a ball with the stream function S of heat-stream: angle = refraction * curl
///   S
///
/// @derivation
///   At constant pressure the density is that of T0 times T0 / (T0 + heat): the share driven out is
///       share = heat / (T0 + heat)                                                                   (1)
///   and the refractive index lacks share (n0 - 1). Its column through a ball of radius R is 16/15 R (n0 - 1)
///   share c, whose gradient across the ray, R and all, is the angle:
///       refraction = 16/15 (n0 - 1) share, n0 - 1 = 2.73e-4                                          (2)
/// @source    [Edl66] refractive index of air at 20 degrees Celsius, 101325 Pa and 550 nm; the Gladstone-Dale
/// relation and the small-angle integral are textbook
/// @deviation the gradient is turned by 90 degrees into a curl, see heat-stream
/// @valid     heat < 0 is treated as 0
/// @accuracy  3 eps
/// @tests     tests/rendering/passes/test_heat_offset.cpp
FX_FORMULA(fxHeatShare)(FX_REAL heat)
{
    FX_REAL h = max(heat, FX_REAL(0.0));
    return h / (FX_REAL(293.15) + h); // (1)
}

FX_FORMULA(fxHeatRefraction)(FX_REAL heat)
{
    return FX_REAL(2.912e-4) * fxHeatShare(heat); // (2)
}
