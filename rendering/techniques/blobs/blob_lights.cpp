/// @file blob_lights.cpp
/// The light of glowing media.
///
/// @formula light-of-media
/// What a group of balls that glow sends into every direction, seen from so far away that it is a point.
///
/// symbol   unit     meaning
///   S, r    m2, m    extinction cross section and radius of a ball
///   B       cd/m2    its source
///   A       m2       area that the ball seems to have
///   u       1        1 - b^2 / r^2 of a ray that passes the middle of the ball at the distance b
///   R       m        radius of an even ball that is as wide as the group: sqrt(5/3) of the rms distance of
///                    the areas from the light, each of an even disc's own width
///   I       cd       intensity
/// @derivation
///   A ray passes the optical depth 3.5 S u^2.5 / (pi r^2) of a ball (kernel-optical-depth), so that
///       A = pi r^2 integral over u in 0..1 of 1 - exp(-3.5 S u^2.5 / (pi r^2))                (1)
///   which is S for thin balls and at most pi r^2. Areas hide each other as discs that lie at random:
///       I = (sum A B) (1 - exp(-N)) / N,  N = (sum A - sum A^2 / sum A) / (pi R^2)            (2)
///   where a ball does not hide itself: of one alone all is seen. So what of the group stands before its
///   light is in (2): within R the group casts no shadow on what its light falls on.
/// @source    elementary; [USS06] for balls of medium
/// @deviation the mean over all directions, and cold balls are taken to lie evenly among hot ones
/// @valid     S >= 0, r > 0
/// @accuracy  A within 4 % of (1), 1 % where it is thin; an even ball of many balls within 25 %
/// @tests     tests/rendering/core/test_lights.cpp
#include "rendering/techniques/blobs/blob_parts.h"

#include "foundation/math/bits.h"
#include "foundation/snapshot/blob_kind.h"
#include "rendering/optics/black_body.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace fx::render {

namespace {

namespace column = base::blob_column;

constexpr float kMinSquare = 1e-6f; // [m2] of the extent

/// (1 - exp(-t)) / t, 1 at t = 0.
float escape(float t)
{
    return t < 1e-4f ? 1.0f - 0.5f * t : -std::expm1(-t) / t;
}

glm::vec3 sourceOf(const base::SnapshotGroup& g, size_t i)
{
    const auto c = [&](size_t index) { return g.column(index)[i]; };
    const glm::vec3 albedo(c(column::AlbedoR), c(column::AlbedoG), c(column::AlbedoB));
    const glm::vec3 own(c(column::EmissionR), c(column::EmissionG), c(column::EmissionB));
    return (1.0f - albedo) * blackBodyLuminance(c(column::Temperature)) + own;
}

/// [m2] (1), by Gauss's rule of four points.
float areaOf(float crossSection, float radius)
{
    constexpr float kPower[] = {0.0012703f, 0.0625628f, 0.3674275f, 0.8353538f}; // u^2.5
    constexpr float kWeight[] = {0.1739274f, 0.3260726f, 0.3260726f, 0.1739274f};
    const float disc = std::numbers::pi_v<float> * radius * radius;
    float seen = 0.0f;
    for (size_t k = 0; k < 4; ++k)
        seen -= kWeight[k] * std::expm1(-3.5f * kPower[k] * crossSection / disc);
    return disc * seen;
}

/// Of the areas of all balls, bright or dark.
struct Areas
{
    double sum = 0.0, squares = 0.0, spread = 0.0;
    glm::dvec3 moment{0.0};

    void add(const glm::vec3& position, float radius, float area)
    {
        const glm::dvec3 p(position);
        sum += double(area);
        squares += double(area) * double(area);
        moment += double(area) * p;
        spread += double(area) * (glm::dot(p, p) + 0.6 * double(radius) * double(radius));
    }
    /// [m] R about a point of the group.
    double reach(const glm::dvec3& center) const
    {
        const double square = spread - 2.0 * glm::dot(center, moment) + sum * glm::dot(center, center);
        return std::sqrt(std::max(5.0 / 3.0 * square / sum, double(kMinSquare)));
    }
    /// [1] N
    double hidden(double reach) const { return (sum - squares / sum) / (std::numbers::pi * reach * reach); }
};

bool lightOf(const base::FrameSnapshot&, const base::SnapshotGroup& g, EffectLight& outLight)
{
    GroupGlow glow;
    Areas areas;
    for (size_t i = 0; i < g.count(); ++i) {
        const float radius = g.column(column::Radius)[i];
        const float crossSection = g.column(column::CrossSection)[i];
        if (!(crossSection > 0.0f && base::isFinite(crossSection) && radius > 0.0f))
            continue;
        const glm::vec3 position(g.column(column::PositionX)[i], g.column(column::PositionY)[i],
                                 g.column(column::PositionZ)[i]);
        const float area = areaOf(crossSection, radius);
        if (base::isFinite(area) && glow.add(position, sourceOf(g, i) * area, radius))
            areas.add(position, radius, area);
    }
    if (glow.isDark())
        return false;
    const double reach = areas.reach(glow.center());
    const float visible = escape(float(areas.hidden(reach))); // (2)
    outLight = glow.light(g.info().placement, glow.extent(kMinSquare), visible);
    outLight.isOfMedium = true;
    outLight.ownReach = float(reach) * g.info().placement.scale;
    return true;
}

} // namespace

constexpr LightSource kBlobLights{&base::kBlobKind, lightOf};

} // namespace fx::render
