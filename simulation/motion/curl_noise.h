/// @file curl_noise.h
/// Turbulent air: a random, divergence-free velocity field. The field mixes particles and does not
/// concentrate them.
///
/// @formula curl-noise
/// The curl of a vector potential of gradient noise, differentiated analytically.
///
/// symbol   unit   meaning
///   p       1      position in units of the noise period
///   f       1      position within its lattice cell, 0..1 on each axis
///   s       1      fade, s(f) = 6 f^5 - 15 f^4 + 10 f^3
///   w       1      weight of a corner: product of s or 1 - s over the axes
///   d       1      position relative to the corner
///   G_k     1      random gradient of potential component k at the corner, each component in [-1, 1]
///   A_k     1      component k of the vector potential
///   theta   turn   phase of the corner, advancing with time
/// @derivation
///   A_k = sum over the 8 corners of w (G_k . d)                                            (1)
///   dA_k/dp_j = sum of (dw/dp_j) (G_k . d) + w G_kj                                        (2)
///   u = N (dA_z/dy - dA_y/dz, dA_x/dz - dA_z/dx, dA_y/dx - dA_x/dy)                        (3)
///   so div u = 0 wherever A is twice differentiable; the fade makes it so everywhere.
///   In time, G_k is replaced by cos(theta) G_k + sin(theta) G_(k+1), which keeps its variance. (4)
/// @source    [BHN07] Bridson, Houriham, Nordenstam, doi:10.1145/1276377.1276435 for the curl of a potential;
///            [PER02] Perlin, doi:10.1145/566654.566636 for the fade
/// @deviation analytic instead of finite differences; time rotates the gradients instead of being a fourth
///            dimension
/// @valid     |p| < 2^30; outside, and for NaN, the lattice coordinate is clamped
/// @accuracy  |div u| <= 1e-3 of the rms gradient (float); rms |u| = strength within 5 %: N is fitted by
///            CurlNoise.itsRootMeanSquareSpeedIsTheStrength
/// @tests     tests/simulation/test_curl_noise.cpp
#pragma once

#include <glm/vec3.hpp>

#include <array>
#include <cstdint>

namespace fx::sim {

/// The field at one moment. Any thread may evaluate the field.
class CurlNoise
{
public:
    /// Creates the field at one moment.
    /// @param seed selects the field
    /// @param strength [m/s] root mean square speed; 0: the velocity is 0
    /// @param scale [m] length of one period, > 0
    /// @param turns number of elapsed periods of the noise's variation in time
    CurlNoise(uint32_t seed, float strength, float scale, double turns);

    bool active() const { return strength_ > 0.0f; }
    /// Velocity [m/s] at `position` [m].
    glm::vec3 velocity(const glm::vec3& position) const;
    /// Adds the velocity at each of `count` positions, with the same bits as velocity(). `count` is rounded
    /// up to a multiple of 16. Columns must be aligned to 64 bytes.
    void addTo(const std::array<const float*, 3>& position, const std::array<float*, 3>& velocity,
               uint32_t count) const;

    /// Parameters of a field for its kernels.
    struct Parts
    {
        uint32_t seed;
        float gain;          ///< [m/s] factor on a field whose mean square is about 1
        float perScale;      ///< [1/m]
        const float* cosine; ///< cosines of kPhases phases
        const float* sine;
    };
    static constexpr uint32_t kPhases = 16;
    Parts parts() const; ///< parameters for the kernels, valid during the lifetime of this object

private:
    uint32_t seed_;
    float strength_;
    float perScale_;
    std::array<float, kPhases> cosine_;
    std::array<float, kPhases> sine_;
};

} // namespace fx::sim
