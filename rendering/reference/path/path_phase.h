/// @file path_phase.h
/// Phase functions that directions are drawn from.
#pragma once

#include <glm/vec3.hpp>

#include <array>
#include <cstdint>

namespace fx::render {

/// Which way light is scattered. A value; const calls from any thread.
class PhaseFunction
{
public:
    static PhaseFunction isotropic() { return {}; }
    static PhaseFunction rayleigh();
    /// @param g mean cosine, -0.999..0.999
    static PhaseFunction henyeyGreenstein(double g);
    /// @param share [0, 1] of light that follows the first lobe
    static PhaseFunction twoLobes(double first, double second, double share);

    /// [1/sr] >= 0, integrates to 1 over all directions. @param cosine between the old and the new direction
    double at(double cosine) const;
    /// Cosine of a direction that is distributed as at(). @param u in [0, 1)
    double cosine(double u) const;
    double meanCosine() const { return share_ * g_[0] + (1.0 - share_) * g_[1]; }

    /// The direction at `cosine` from `direction`, turned by `turn` in [0, 1) of a circle.
    static glm::dvec3 around(const glm::dvec3& direction, double cosine, double turn);

    bool operator==(const PhaseFunction&) const = default;

private:
    bool isRayleigh_ = false;
    std::array<double, 2> g_{0.0, 0.0};
    double share_ = 1.0;
};

} // namespace fx::render
