/// @file blob_lights.cpp
/// The light of glowing media.
///
/// @formula light-of-media
/// What a group of balls that glow sends into the mean of all directions, seen from so far away that it is a
/// point.
///
/// symbol   unit     meaning
///   S, r    m2, m    extinction cross section and radius of a ball
///   B       cd/m2    its source
///   A       m2       area that the ball seems to have by itself
///   u       1        1 - b^2 / r^2 of a ray that passes the middle of the ball at the distance b
///   W       cd       sum of A B of all balls
///   L       cd/m2    radiance of a line at its ends, mean of both
///   D       1/m2     density of the lines that are drawn
///   k, w    1/m, 1   extinction of the sum of all balls, with detail, and its albedo
///   R       m        radius of the group about its light
///   I       cd       intensity
/// @derivation
///   A ray passes the optical depth 3.5 S u^2.5 / (pi r^2) of a ball (kernel-optical-depth), so that
///       A = pi r^2 integral over u in 0..1 of 1 - exp(-3.5 S u^2.5 / (pi r^2))                (1)
///   which is S for thin balls and at most pi r^2. The mean intensity is the integral of the radiance over
///   all lines,
///       I = 1/(4 pi) integral of L over directions and the plane across them                  (2)
///   Lines are drawn through balls, the more the brighter they are by themselves, with even directions and
///   even over the disc of the ball. A line that meets several balls could have come from each, so that its
///   density is
///       D = 1/W sum over balls on the line of A B / (pi r^2)                                   (3)
///       I = mean of L / D over the lines                                                      (4)
///   Each ball has its own lines, which move with it; those of a ball that has less than one come and go
///   smoothly as its share of W changes. What scatters hides less than what absorbs: in two streams light
///   decays over a depth with the exponent sqrt(1 - w), and an even deep medium shines with 2 sqrt(1 - w) /
///   (1 + sqrt(1 - w)) of B0 = B / (1 - w):
///       dL = (B / sqrt(1 - w) - L) sqrt(1 - w) k ds                                            (5)
///       L' = L (1 + (1 - T) (1 - sqrt(1 - w)) / (1 + sqrt(1 - w))), T = L's transmittance      (6)
///   All that stands before the light is in (5), so that the group casts no shadow within R,
///       R = (9 mean of d^24)^(1/24)                                                            (7)
///   for the distances d of areas A from the light; of an even ball it is the radius. The power is high, so
///   that R reaches the outermost soot: soot beyond R would hide the light a second time.
/// @source    elementary; [USS06] for balls of medium
/// @deviation the mean over all directions; g of the phase function is not seen
/// @valid     S >= 0, r > 0
/// @accuracy  (1) within 4 %, 1 % where it is thin; 96 lines: a thin ball within 2 %, a cloud of even
///            temperature within 10 %
/// @tests     tests/rendering/core/test_lights.cpp
#include "foundation/math/bits.h"
#include "foundation/snapshot/blob_kind.h"
#include "rendering/techniques/blobs/blob_parts.h"
#include "rendering/techniques/blobs/blob_radiance.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace fx::render {

namespace {

namespace column = base::blob_column;

constexpr float kMinSquare = 1e-6f; // [m2] of the extent

/// Calls use(position, radius, area, ball) for each ball that is drawn.
template <typename Use>
void forBalls(const base::SnapshotGroup& g, const Use& use)
{
    for (size_t i = 0; i < g.count(); ++i) {
        const float radius = g.column(column::Radius)[i];
        const float crossSection = g.column(column::CrossSection)[i];
        if (!(crossSection > 0.0f && base::isFinite(crossSection) && radius > 0.0f))
            continue;
        const glm::vec3 position(g.column(column::PositionX)[i], g.column(column::PositionY)[i],
                                 g.column(column::PositionZ)[i]);
        const float area = blobArea(crossSection, radius);
        if (base::isFinite(area) && base::isFinite(glm::dot(position, position)))
            use(position, radius, area, i);
    }
}

/// As bright as it would be if no ball hid another: an upper bound.
bool lightOf(const base::FrameSnapshot&, const base::SnapshotGroup& g, EffectLight& outLight)
{
    GroupGlow glow;
    forBalls(g, [&](const glm::vec3& position, float radius, float area, size_t i) {
        glow.add(position, blobSource(g, i) * area, radius);
    });
    if (glow.isDark())
        return false;
    const glm::dvec3 center = glow.center();
    double sum = 0.0, moment = 0.0;
    forBalls(g, [&](const glm::vec3& position, float radius, float area, size_t) {
        const glm::dvec3 away = glm::dvec3(position) - center;
        const double square = glm::dot(away, away) + double(radius) * double(radius);
        sum += double(area);
        const double eighth = square * square * square * square;
        moment += double(area) * eighth * eighth * eighth;
    });
    outLight = glow.light(g.info().placement, glow.extent(kMinSquare), 1.0f);
    outLight.isOfMedium = true;
    outLight.ownReach = float(std::pow(9.0 * moment / sum, 1.0 / 24.0)) * g.info().placement.scale; // (7)
    return true;
}

void complete(const base::FrameSnapshot& snapshot, size_t group, EffectLight& ioLight)
{
    const float scale = snapshot.group(group).info().placement.scale;
    ioLight.intensity = blobIntensity(snapshot, group) * (scale * scale);
}

} // namespace

constexpr LightSource kBlobLights{&base::kBlobKind, lightOf, complete};

} // namespace fx::render
