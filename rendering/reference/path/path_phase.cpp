#include "rendering/reference/path/path_phase.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace fx::render {

namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kIsotropic = 1e-6; ///< |g| below which a lobe is isotropic, or its inverse loses all digits

double lobe(double cosine, double g)
{
    const double d = std::max(1.0 + g * g - 2.0 * g * cosine, (1.0 - std::abs(g)) * (1.0 - std::abs(g)));
    return (1.0 - g * g) / (4.0 * kPi * d * std::sqrt(d));
}

double lobeCosine(double u, double g)
{
    if (std::abs(g) < kIsotropic)
        return 1.0 - 2.0 * u;
    const double s = (1.0 - g * g) / (1.0 + g - 2.0 * g * u);
    return std::clamp((1.0 + g * g - s * s) / (2.0 * g), -1.0, 1.0);
}

} // namespace

PhaseFunction PhaseFunction::rayleigh()
{
    PhaseFunction phase;
    phase.isRayleigh_ = true;
    return phase;
}

PhaseFunction PhaseFunction::henyeyGreenstein(double g)
{
    return twoLobes(g, 0.0, 1.0);
}

PhaseFunction PhaseFunction::twoLobes(double first, double second, double share)
{
    PhaseFunction phase;
    phase.g_ = {first, second};
    phase.share_ = share;
    return phase;
}

double PhaseFunction::at(double cosine) const
{
    if (isRayleigh_)
        return 3.0 / (16.0 * kPi) * (1.0 + cosine * cosine);
    double value = share_ * lobe(cosine, g_[0]);
    if (share_ < 1.0)
        value += (1.0 - share_) * lobe(cosine, g_[1]);
    return value;
}

double PhaseFunction::cosine(double u) const
{
    if (isRayleigh_) {
        // The distribution function is a cubic in the cosine with one real root.
        const double q = 4.0 * u - 2.0;
        const double root = std::cbrt(std::sqrt(q * q + 1.0) - q);
        return std::clamp(root - 1.0 / root, -1.0, 1.0);
    }
    if (u < share_)
        return lobeCosine(u / share_, g_[0]);
    return lobeCosine((u - share_) / (1.0 - share_), g_[1]);
}

glm::dvec3 PhaseFunction::around(const glm::dvec3& direction, double cosine, double turn)
{
    // A basis without branches that vanish: the sign of z keeps 1 + |z| away from zero.
    const double sign = std::copysign(1.0, direction.z);
    const double a = -1.0 / (sign + direction.z);
    const double b = direction.x * direction.y * a;
    const glm::dvec3 x(1.0 + sign * direction.x * direction.x * a, sign * b, -sign * direction.x);
    const glm::dvec3 y(b, sign + direction.y * direction.y * a, -direction.y);
    const double sine = std::sqrt(std::max(0.0, 1.0 - cosine * cosine));
    const double angle = 2.0 * kPi * turn;
    return glm::normalize(cosine * direction + sine * (std::cos(angle) * x + std::sin(angle) * y));
}

} // namespace fx::render
