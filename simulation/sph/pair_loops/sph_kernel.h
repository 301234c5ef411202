/// @file sph_kernel.h
/// The smoothing kernels of the gas.
///
/// @formula sph-kernels
/// Kernels of compact support: a shape w(q), a constant that makes the integral 1, and a radius.
///
/// symbol   unit    meaning
///   H       m       radius of the support, beyond which the kernel is exactly 0
///   r       m       distance
///   q       1       r / H
///   W       1/m3    kernel
///   w       1       its shape
///   C       1       its constant
///   k       1       wave number in units of 1 / H
///   N       1       neighbors, 4/3 pi H^3 times the number density
///   e       1       share of the self-contribution that the density omits
/// @derivation
///   W = C / H^3 w(q),  gradient of W = C / H^5 (w'(q) / q) (x_i - x_j),
///   dW/dH = -C / H^4 (3 w + q w'),  C = 1 / (4 pi integral of q^2 w over [0, 1])               (1)
///   Wendland C2:  w = (1 - q)^4 (1 + 4 q),               w'/q = -20 (1 - q)^3                  (2)
///   Wendland C4:  w = (1 - q)^6 (1 + 6 q + 35/3 q^2),    w'/q = -56/3 (1 - q)^5 (1 + 5 q)      (3)
///   Cubic spline: w = (1 - q)^3 - 4 max(1/2 - q, 0)^3,
///                 w'/q = -3 (1 - p)^2 / p - 9 (p - q) with p = max(q, 1/2)                     (4)
///   The paper's:  w = (1 - q^2)^n,                       w'/q = -2 n (1 - q^2)^(n - 1)         (5)
///   Fourier transform: 4 pi / k integral of q w sin(k q) over [0, 1]. Where it is negative, a lattice of
///   particles is unstable, and neighbors form pairs (pairing instability)                       (6)
///   The self-contribution of a particle exceeds the density that the particle represents, by the share
///   e = 0.0294 (N / 100)^-0.977 for C2 and 0.01342 (N / 100)^-1.579 for C4                     (7)
/// @source    [DA12] table 1 for (2)-(4), section 2 for (6), eq. (18) for (7),
///            doi:10.1111/j.1365-2966.2012.21439.x; [WEN95] for (2), (3)
/// @deviation the last term of (4) continues the outer branch; the result equals the two cases of the
///            textbook. (7) is 0 for (4) and (5), for which nothing has been published
/// @valid     0 <= q <= 1. Forces with (5) are unstable at any number of neighbors and those with (4) beyond
/// 50
/// @accuracy  float rounding: relative error <= 1e-6 of w(0)
/// @tests     tests/simulation/pair_loops/test_sph_kernel.cpp
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <string_view>

namespace fx::sim {

/// Kernels W(r; H) = C / H^3 w(q), q = r / H in [0, 1], with integral 1 over space.
enum class SphKernel : uint8_t
{
    WendlandC2,  ///< the default kernel
    WendlandC4,  ///< suited to 100 neighbors and more
    CubicSpline, ///< particles form pairs if there are more than 50 neighbors
    Quartic,     ///< (1 - q^2)^2, the kernel of [UBT96]; for density and pictures, unstable for forces
    Sextic,      ///< (1 - q^2)^3, for density and pictures only
    Octic        ///< (1 - q^2)^4, for density and pictures only
};

constexpr std::array<SphKernel, 6> kSphKernels{SphKernel::WendlandC2,  SphKernel::WendlandC4,
                                               SphKernel::CubicSpline, SphKernel::Quartic,
                                               SphKernel::Sextic,      SphKernel::Octic};

struct KernelFacts
{
    std::string_view name; ///< name in commands and files, such as "wendland-c2"
    double norm;           ///< [1] factor C of the kernel
    double center;         ///< [1] w(0)
    /// [1] Largest number of neighbors for which forces are stable. It is infinite if the Fourier transform
    /// of the kernel is nowhere negative, and 0 if forces are always unstable.
    double largestNeighbors;
};

KernelFacts kernelFacts(SphKernel kernel);

/// [1/m3] Kernel W(r; H), 0 beyond the support.
double kernelValue(SphKernel kernel, double r, double support);
/// [1/m4] Derivative dW/dr of the kernel.
double kernelSlope(SphKernel kernel, double r, double support);
/// [1/m4] Derivative dW/dH of the kernel.
double kernelSupportSlope(SphKernel kernel, double r, double support);

/// [1] Fraction of the self-contribution that the density omits, in [0, 1/2].
double selfBias(SphKernel kernel, double neighbors);

} // namespace fx::sim
