/// @file elementary.h
/// Elementary functions for simulation kernels. The functions give the same bits on every machine. Functions
/// of the C library may give different bits.
///
/// Only +, -, *, / and conversions are used, in a fixed order; callers build with -ffp-contract=off.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

namespace fx::base {

/// Computes 2^n for -1022 <= n <= 1023.
inline double powerOfTwo(int n)
{
    return std::bit_cast<double>(uint64_t(n + 1023) << 52);
}

/// @formula natural-exponential
/// e^x by reduction to |r| <= ln(2)/2 and the Taylor polynomial.
///
/// symbol   unit   meaning
///   x       1      argument
///   n       1      nearest integer to x / ln 2
///   r       1      remainder, x - n ln 2
/// @derivation
///   x = n ln 2 + r, with ln 2 in two pieces so that n times the first is exact      (1)
///   e^x = 2^n e^r                                                                    (2)
///   e^r = sum r^k / k!, k = 0..13; the next term is below 5e-18                      (3)
/// @source    [MUL16] section 11 for the reduction; the series is elementary
/// @deviation Taylor instead of minimax coefficients
/// @valid     x < -708 gives 0; x > 709 gives e^709; 0 gives exactly 1; NaN gives NaN
/// @accuracy  relative error <= 1e-15
/// @tests     tests/foundation/test_elementary.cpp
inline double naturalExp(double x)
{
    if (x < -708.0)
        return 0.0;
    if (x > 709.0)
        x = 709.0;
    if (x != x)
        return x;
    const double n = std::floor(x * 1.4426950408889634 + 0.5);
    const double r = (x - n * 6.93147180369123816490e-01) - n * 1.90821492927058770002e-10; // (1)
    double sum = 1.0 / 6227020800.0;                                                        // (3)
    sum = sum * r + 1.0 / 479001600.0;
    sum = sum * r + 1.0 / 39916800.0;
    sum = sum * r + 1.0 / 3628800.0;
    sum = sum * r + 1.0 / 362880.0;
    sum = sum * r + 1.0 / 40320.0;
    sum = sum * r + 1.0 / 5040.0;
    sum = sum * r + 1.0 / 720.0;
    sum = sum * r + 1.0 / 120.0;
    sum = sum * r + 1.0 / 24.0;
    sum = sum * r + 1.0 / 6.0;
    sum = sum * r + 0.5;
    sum = sum * r + 1.0;
    sum = sum * r + 1.0;
    return sum * powerOfTwo(int(n)); // (2)
}

/// @formula natural-logarithm
/// ln x from the exponent and the series of the inverse hyperbolic tangent.
///
/// symbol   unit   meaning
///   x       1      argument, > 0
///   e       1      exponent
///   m       1      mantissa, sqrt(1/2) <= m < sqrt(2)
///   s       1      (m - 1) / (m + 1), |s| <= 0.172
/// @derivation
///   x = 2^e m, ln x = e ln 2 + ln m, with ln 2 in two pieces so that e times the first is exact   (1)
///   ln m = 2 artanh s = 2 s (1 + s^2/3 + s^4/5 + ...); the term of s^22 is below 1e-18              (2)
/// @source    [MUL16] section 11 for the reduction; the series is elementary
/// @deviation none
/// @valid     0 and denormal numbers give -infinity; negative numbers and NaN give NaN; 1 gives exactly 0
/// @accuracy  relative error <= 5e-16
/// @tests     tests/foundation/test_elementary.cpp
inline double naturalLog(double x)
{
    if (!(x >= 2.2250738585072014e-308))
        return x >= 0 ? -std::numeric_limits<double>::infinity() : std::numeric_limits<double>::quiet_NaN();
    if (x > 1.7976931348623157e308)
        return x;
    const uint64_t bits = std::bit_cast<uint64_t>(x);
    int e = int(bits >> 52) - 1023;
    double m = std::bit_cast<double>((bits & 0x000FFFFFFFFFFFFFu) | 0x3FF0000000000000u);
    if (m > 1.4142135623730951) {
        m = 0.5 * m;
        ++e;
    }
    const double s = (m - 1.0) / (m + 1.0);
    const double z = s * s;
    double sum = 1.0 / 21.0; // (2)
    sum = sum * z + 1.0 / 19.0;
    sum = sum * z + 1.0 / 17.0;
    sum = sum * z + 1.0 / 15.0;
    sum = sum * z + 1.0 / 13.0;
    sum = sum * z + 1.0 / 11.0;
    sum = sum * z + 1.0 / 9.0;
    sum = sum * z + 1.0 / 7.0;
    sum = sum * z + 1.0 / 5.0;
    sum = sum * z + 1.0 / 3.0;
    const double logM = 2.0 * s + 2.0 * s * z * sum;
    return e * 6.93147180369123816490e-01 + (e * 1.90821492927058770002e-10 + logM); // (1)
}

/// Computes x^y = e^(y ln x) for x >= 0, with a relative error <= 1e-15 (2 + |y ln x|). The result has the
/// same bits on every machine. 0^y is 0 for y > 0, and x^0 is exactly 1. Results are at most e^709.
inline double power(double x, double y)
{
    return y == 0.0 ? 1.0 : naturalExp(y * naturalLog(x));
}

/// @formula cube-root
/// x^(1/3) by Halley's iteration from a guess made of the exponent bits.
///
/// symbol   unit   meaning
///   x       1      argument
///   y       1      approximation of its cube root
/// @derivation
///   A third of the bit pattern of x plus a constant is a number with about a third of the exponent of x. It
///   is within 6 % of the cube root                                                           (1)
///   A step y <- y (y^3 + 2 x) / (2 y^3 + x) reduces a relative error d to about 2/3 d^3      (2)
///   After one, two and three steps the relative error is 2e-4, 3e-12 and below that of rounding.
/// @source    [MUL16] for bit-pattern guesses; Halley's iteration is textbook
/// @deviation none
/// @valid     odd function; |x| < 1e-300 gives 0; infinite and NaN arguments are not accepted
/// @accuracy  relative error <= 1e-15
/// @tests     tests/foundation/test_elementary.cpp
inline double cubeRoot(double x)
{
    const double a = x < 0 ? -x : x;
    if (!(a >= 1e-300))
        return 0.0;
    double y = std::bit_cast<double>(std::bit_cast<uint64_t>(a) / 3 + 0x2A9F7893782DA1CEu); // (1)
    for (int i = 0; i < 3; ++i) {
        const double cube = y * y * y;
        y = y * ((cube + 2.0 * a) / (2.0 * cube + a)); // (2)
    }
    return x < 0 ? -y : y;
}

/// Sine and cosine of an angle.
struct SinCos
{
    double sin;
    double cos;
};

/// @formula sine-cosine-of-turns
/// Sine and cosine of 2 pi times the argument. With the argument in turns, the range reduction is exact.
///
/// symbol   unit   meaning
///   t       turn   angle
///   q       1      nearest quarter turn, -2..2
///   a       rad    remainder of the angle, |a| <= pi/4
/// @derivation
///   t - floor(t + 1/2) = q/4 + a/(2 pi), exact in binary arithmetic   (1)
///   Taylor series of sine to a^15 and cosine to a^16                   (2)
///   A rotation by q quarter turns exchanges sine and cosine and changes signs   (3)
/// @source    elementary
/// @deviation none
/// @valid     |t| < 2^50; multiples of 1/4 give exactly 0 and +-1
/// @accuracy  absolute error <= 4e-16
/// @tests     tests/foundation/test_elementary.cpp
inline SinCos sinCosTurns(double t)
{
    const double part = t - std::floor(t + 0.5);
    const double q = std::floor(4.0 * part + 0.5);
    const double a = 6.283185307179586476925 * (part - 0.25 * q); // (1)
    const double z = a * a;
    double s = -1.0 / 1307674368000.0; // (2)
    s = s * z + 1.0 / 6227020800.0;
    s = s * z - 1.0 / 39916800.0;
    s = s * z + 1.0 / 362880.0;
    s = s * z - 1.0 / 5040.0;
    s = s * z + 1.0 / 120.0;
    s = s * z - 1.0 / 6.0;
    s = a + a * z * s;
    double c = 1.0 / 20922789888000.0;
    c = c * z - 1.0 / 87178291200.0;
    c = c * z + 1.0 / 479001600.0;
    c = c * z - 1.0 / 3628800.0;
    c = c * z + 1.0 / 40320.0;
    c = c * z - 1.0 / 720.0;
    c = c * z + 1.0 / 24.0;
    c = c * z - 0.5;
    c = c * z + 1.0;
    switch (int(q) & 3) { // (3)
    case 0:
        return {s, c};
    case 1:
        return {c, -s};
    case 2:
        return {-s, -c};
    default:
        return {-c, s};
    }
}

/// Cubic function that increases from 0 at `edge0` to 1 at `edge1` > `edge0`, with zero slope at both ends.
inline float smoothStep(float edge0, float edge1, float x)
{
    const float t = (x - edge0) / (edge1 - edge0);
    const float u = t > 0.0f ? (t < 1.0f ? t : 1.0f) : 0.0f;
    return u * u * (3.0f - 2.0f * u);
}

} // namespace fx::base
