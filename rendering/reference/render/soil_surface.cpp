#include "rendering/reference/render/soil_surface.h"

#include "shaders/formulas/formula.h"

#include <glm/geometric.hpp>
#include <glm/vec4.hpp>

#include <algorithm>
#include <cmath>

namespace fx::render {

namespace {

constexpr int kOctaves = 7;
constexpr double kMaxTaps = 6.0;
constexpr double kLeastCosine = 0.005; ///< of a ray to the vertical: bounds the length of a pixel's image

/// Slopes, relative albedo and hue.
glm::dvec4 octavesAt(const glm::dvec2& place, double p)
{
    using namespace formula64;
    glm::dvec4 sum(0.0);
    glm::dvec2 turn(1.0, 0.0);
    for (int k = 0; k < kOctaves; ++k) {
        const double l = fxSoilSize(double(k));
        const double band = fxOctaveBand(l, p);
        if (band <= 0.0)
            break;
        const double x = (turn.x * place.x - turn.y * place.y) / l + 17.3 * k;
        const double z = (turn.y * place.x + turn.x * place.y) / l + 17.3 * k;
        const double gx = fxSoilSlopeX(x, z), gz = fxSoilSlopeZ(x, z);
        const double n = band * fxSoilNoise(x, z);
        const double steepness = band * fxSoilSteepness(l);
        sum += glm::dvec4(steepness * (turn.x * gx + turn.y * gz), steepness * (turn.x * gz - turn.y * gx),
                          fxSoilContrast(l) * n, k % 2 == 1 ? n : 0.0);
        turn = {0.8 * turn.x - 0.6 * turn.y, 0.6 * turn.x + 0.8 * turn.y};
    }
    return sum;
}

} // namespace

glm::dvec3 SoilSurface::normal(const glm::dvec3& n) const
{
    return glm::normalize(n - glm::dvec3(slope.x, 0.0, slope.y));
}

SoilSurface soilAt(const glm::dvec2& place, const glm::dvec2& along, double width)
{
    const double length = glm::length(along);
    const double taps = std::clamp(std::ceil(length / std::max(width, 1e-6)), 1.0, kMaxTaps);
    const double p = std::max(width, length / taps);
    glm::dvec4 sum(0.0);
    for (double i = 0.5; i < taps; ++i)
        sum += octavesAt(place + along * (i / taps - 0.5), p) / taps;
    SoilSurface soil;
    soil.share = std::max(1.0 + sum.z, 0.2) * glm::dvec3(1.0 + 0.12 * sum.w, 1.0, 1.0 - 0.16 * sum.w);
    soil.slope = {sum.x, sum.y};
    return soil;
}

SoilSurface soilSeen(const glm::dvec2& place, const glm::dvec3& direction, double width)
{
    const glm::dvec2 level(direction.x, direction.z);
    const double cosine = std::max(std::abs(direction.y), kLeastCosine);
    const double flat = glm::length(level);
    return soilAt(place, flat > 0.0 ? level * (width / (cosine * flat)) : glm::dvec2(width, 0.0), width);
}

} // namespace fx::render
