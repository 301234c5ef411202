/// @file path_phase.h
/// Phase functions from which directions can be sampled.
#pragma once

#include <glm/vec3.hpp>

#include <array>
#include <cstdint>

namespace fx::render {

/// A phase function, as a value type. Threads: any thread may call const functions.
class PhaseFunction
{
public:
    static PhaseFunction isotropic() { return {}; }
    static PhaseFunction rayleigh();
    /// @param g mean cosine, -0.999..0.999
    static PhaseFunction henyeyGreenstein(double g);
    /// @param share share of the first lobe, 0..1  @param first, second mean cosines
    static PhaseFunction twoLobes(double first, double second, double share);

    /// [1/sr] >= 0, integrates to 1 over all directions. @param cosine between the old and the new direction
    double at(double cosine) const;
    /// Samples the cosine of a direction with the density at(). @param u in [0, 1)
    double cosine(double u) const;
    double meanCosine() const { return share_ * g_[0] + (1.0 - share_) * g_[1]; }

    /// A direction with the given cosine to `direction`, rotated about it by `turn` in [0, 1) turns.
    static glm::dvec3 around(const glm::dvec3& direction, double cosine, double turn);

    bool operator==(const PhaseFunction&) const = default;

private:
    bool isRayleigh_ = false;
    std::array<double, 2> g_{0.0, 0.0};
    double share_ = 1.0;
};

} // namespace fx::render
