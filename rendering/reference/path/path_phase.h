/// @file path_phase.h
/// Phase functions from which directions can be sampled.
#pragma once

#include <glm/vec3.hpp>

#include <array>
#include <cstdint>

namespace fx::render {

/// A phase function. Threads: any thread may call const functions.
class PhaseFunction
{
public:
    static PhaseFunction isotropic() { return {}; }
    static PhaseFunction rayleigh();
    /// The Henyey-Greenstein function.
    /// @param g mean cosine, -0.999..0.999
    static PhaseFunction henyeyGreenstein(double g);
    /// A weighted sum of two Henyey-Greenstein functions.
    /// @param share weight of the first lobe, 0..1  @param first, second mean cosines of the lobes
    static PhaseFunction twoLobes(double first, double second, double share);

    /// [1/sr] Value of the phase function, >= 0; its integral over all directions is 1.
    /// @param cosine cosine of the angle between the old and the new direction
    double at(double cosine) const;
    /// Samples the cosine of the angle of scattering with the density at().
    /// @param u random number in [0, 1)
    double cosine(double u) const;
    double meanCosine() const { return share_ * g_[0] + (1.0 - share_) * g_[1]; }

    /// Returns the direction whose angle to `direction` has the given cosine. `turn` [turns] is its azimuth
    /// about `direction`, [0, 1).
    static glm::dvec3 around(const glm::dvec3& direction, double cosine, double turn);

    bool operator==(const PhaseFunction&) const = default;

private:
    bool isRayleigh_ = false;
    std::array<double, 2> g_{0.0, 0.0};
    double share_ = 1.0;
};

} // namespace fx::render
