/// @file wendland.h
/// The smoothing kernel of the gas.
///
/// @formula wendland-c2
/// A compact kernel whose Fourier transform is positive, so that particles never clump in pairs.
///
/// symbol   unit   meaning
///   h       m      smoothing length; the kernel reaches to 2 h
///   r       m      distance
///   q       1      r / h
///   W       1/m3   kernel
///   g       1/m5   (dW/dr) / r: the gradient is g times the vector between the particles
/// @derivation
///   W = 21 / (16 pi h^3) (1 - q/2)^4 (2 q + 1) for q < 2, else 0; its integral over space is 1     (1)
///   dW/dr = 21 / (16 pi h^4) (-5 q) (1 - q/2)^3, so
///   g = -105 / (16 pi h^5) (1 - q/2)^3: no division by r, coincident particles are no special case (2)
/// @source    [DA12] Dehnen and Aly, table 1, doi:10.1111/j.1365-2966.2012.21439.x; [WEN95]
/// doi:10.1007/BF02123482
/// @deviation none
/// @valid     r >= 0, h > 0
/// @accuracy  float rounding: relative error <= 1e-6 of W(0)
/// @tests     tests/simulation/test_wendland.cpp
#pragma once

#include <algorithm>

namespace fx::sim {

constexpr float kWendlandSupport = 2.0f;     ///< [1] reach of the kernel in smoothing lengths
constexpr float kWendlandCenter = 0.417781f; ///< [1] W(0) h^3 = 21 / (16 pi)

/// The kernel for one smoothing length.
class Wendland
{
public:
    explicit Wendland(float h)
        : perH_(1.0f / h), peak_(kWendlandCenter * perH_ * perH_ * perH_),
          steep_(-5.0f * peak_ * perH_ * perH_)
    {}

    float value(float r) const
    {
        const float q = r * perH_;
        const float u = std::max(1.0f - 0.5f * q, 0.0f);
        const float u2 = u * u;
        return peak_ * u2 * u2 * (2.0f * q + 1.0f); // (1)
    }
    float gradient(float r) const
    {
        const float u = std::max(1.0f - 0.5f * r * perH_, 0.0f);
        return steep_ * u * u * u; // (2)
    }

private:
    float perH_;  ///< [1/m]
    float peak_;  ///< [1/m3] W(0)
    float steep_; ///< [1/m5] g(0)
};

} // namespace fx::sim
