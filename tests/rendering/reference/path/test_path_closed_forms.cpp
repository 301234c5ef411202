#include "rendering/reference/path/path_integrator.h"

#include "tests/rendering/reference/path/path_statistics.h"
#include "tests/rendering/reference/path/path_test_media.h"

#include <glm/geometric.hpp>

#include <gtest/gtest.h>

#include <array>
#include <numbers>
#include <vector>

namespace fx::render {
namespace {

constexpr double kPi = std::numbers::pi;

struct WhiteSky final : PathSky
{
    glm::dvec3 luminance(const glm::dvec3&) const override { return glm::dvec3(1.0); }
};

/// [m] that a ray from `origin` is inside a ball around the origin.
double lengthInBall(const glm::dvec3& origin, const glm::dvec3& direction, double radius)
{
    const double nearest = -glm::dot(origin, direction);
    const double half2 = radius * radius - glm::dot(origin, origin) + nearest * nearest;
    return half2 > 0.0 ? nearest + std::sqrt(half2) - std::max(0.0, nearest - std::sqrt(half2)) : 0.0;
}

/// Light of one path with the sky as background.
double seen(const PathResult& path, const PathScene& scene)
{
    const bool isBehind = path.sawBackground && scene.sky;
    return path.luminance.x + (isBehind ? path.throughput.x * scene.sky->luminance({}).x : 0.0);
}

Statistics traced(const PathScene& scene, const PathSettings& settings, const TraceRay& ray, uint32_t paths)
{
    PathIntegrator integrator(scene, settings);
    Statistics result;
    for (uint32_t i = 0; i < paths; ++i) {
        PathSampler sampler(12, 0, i);
        result.add(seen(integrator.trace(ray, 0.0, sampler), scene));
    }
    return result;
}

TEST(PathClosedForms, singleScatteringInABall)
{
    const double extinction = 2.5, albedo = 0.8, radius = 1.0;
    const glm::dvec3 toSun = glm::normalize(glm::dvec3(0.4, 1.0, 0.3));
    const SunLight sun(toSun, glm::dvec3(3.0), 0.0);
    const std::array<const PathLight*, 1> lights{&sun};
    for (const double g : {0.0, 0.7, -0.3})
        for (const double offset : {0.0, 0.6}) {
            const PhaseFunction phase = PhaseFunction::henyeyGreenstein(g);
            const HomogeneousMedium medium({MediumShape::Kind::Ball, {}, {radius, 0, 0}},
                                           substance(extinction, albedo, phase));
            const TraceRay ray{{-4.0, offset, 0.2}, {1, 0, 0}};
            const double nearest = 4.0;
            const double half = std::sqrt(radius * radius - offset * offset - 0.04);
            double expected = 0.0;
            constexpr int kSteps = 20000;
            for (int i = 0; i < kSteps; ++i) {
                const double s = 2.0 * half * (i + 0.5) / kSteps;
                const glm::dvec3 position = ray.origin + (nearest - half + s) * ray.direction;
                expected += std::exp(-extinction * (s + lengthInBall(position, toSun, radius)));
            }
            expected *=
                2.0 * half / kSteps * albedo * extinction * phase.at(glm::dot(ray.direction, toSun)) * 3.0;
            PathScene scene;
            scene.medium = &medium;
            scene.lights = lights;
            const Statistics result = traced(scene, {.bounces = 1}, ray, 20000);
            EXPECT_NEAR(result.mean(), expected, 3.0 * result.error()) << g << ' ' << offset;
        }
}

TEST(PathClosedForms, singleScatteringInASlab)
{
    // Seen from above at cosine m, lit from above at cosine n: a p E m / (m + n) (1 - exp(-t (1 / m + 1 /
    // n))) / m.
    const double depth = 1.7, albedo = 0.6;
    const double m = 0.5, n = 0.8;
    const glm::dvec3 toSun(std::sqrt(1.0 - n * n), n, 0.0);
    const glm::dvec3 downwards(0.0, -m, std::sqrt(1.0 - m * m));
    const SunLight sun(toSun, glm::dvec3(2.0), 0.0);
    const std::array<const PathLight*, 1> lights{&sun};
    const HomogeneousMedium medium({MediumShape::Kind::Slab, {}, {0, 0.5, 0}}, substance(depth, albedo), true,
                                   1.7);
    const double expected =
        albedo * 2.0 / (4.0 * kPi) * n / (m + n) * (1.0 - std::exp(-depth * (1.0 / m + 1.0 / n)));
    PathScene scene;
    scene.medium = &medium;
    scene.lights = lights;
    const Statistics result = traced(scene, {.bounces = 1}, {{0, 3, 0}, downwards}, 20000);
    EXPECT_NEAR(result.mean(), expected, 3.0 * result.error());
}

/// Chandrasekhar's H function of isotropic scattering at the midpoints of equal intervals, and at `m` as the
/// last entry.
std::vector<double> hFunction(double albedo, double m)
{
    constexpr int kNodes = 800;
    std::vector<double> h(kNodes + 1, 1.0);
    for (int sweep = 0; sweep < 400; ++sweep) {
        std::vector<double> next(h.size());
        for (int i = 0; i <= kNodes; ++i) {
            const double mu = i < kNodes ? (i + 0.5) / kNodes : m;
            double integral = 0.0;
            for (int j = 0; j < kNodes; ++j) {
                const double nu = (j + 0.5) / kNodes;
                integral += nu * h[size_t(j)] / (mu + nu) / kNodes;
            }
            next[size_t(i)] = 1.0 / (std::sqrt(1.0 - albedo) + 0.5 * albedo * integral);
        }
        h = next;
    }
    return h;
}

TEST(PathClosedForms, aDeepSlabReflectsWhatChandrasekharSays)
{
    // Optical depth 60: of albedo 0.99, exp(-2 * 60 * 0.1725) = 1e-9 of the light would come back from below.
    for (const double albedo : {0.5, 0.9, 0.99})
        for (const double m : {1.0, 0.4}) {
            const double expected = 1.0 - hFunction(albedo, m).back() * std::sqrt(1.0 - albedo);
            const HomogeneousMedium medium({MediumShape::Kind::Slab, {0, -30, 0}, {0, 30, 0}},
                                           substance(1.0, albedo));
            MediumTracker tracker(&medium, FlightEstimator::Depth, ShadowEstimator::Exact);
            Statistics reflected;
            for (uint32_t i = 0; i < 30000; ++i) {
                PathSampler sampler(3, 0, i);
                const Escape out = escape(tracker, {{0, 1, 0}, {std::sqrt(1.0 - m * m), -m, 0}}, sampler);
                reflected.add(out.isOut && out.ray.direction.y > 0.0 ? out.throughput.x : 0.0);
            }
            EXPECT_NEAR(reflected.mean(), expected, 3.0 * reflected.error()) << albedo << ' ' << m;
            EXPECT_LT(reflected.error(), 0.003);
        }
}

TEST(PathClosedForms, whiteMediaInAWhiteSkyAreInvisible)
{
    const auto tasks = base::makeSerialRunner();
    const BlobPathMedium blobs(someBlobs(60, 1.0, glm::dvec3(1.0), 0.7), glm::dvec3(0.0), *tasks);
    const BlobPathMedium thin(someBlobs(60, 0.01, glm::dvec3(1.0), 0.7), glm::dvec3(0.0), *tasks);
    const HomogeneousMedium ball({MediumShape::Kind::Ball, {}, {1, 0, 0}},
                                 substance(6.0, 1.0, PhaseFunction::rayleigh()), true, 2.0);
    const WhiteSky sky;
    for (const PathMedium* medium :
         {static_cast<const PathMedium*>(&blobs), static_cast<const PathMedium*>(&thin),
          static_cast<const PathMedium*>(&ball)})
    {
        PathScene scene;
        scene.medium = medium;
        scene.sky = &sky;
        PathIntegrator integrator(scene, {});
        double opacity = 0.0;
        for (uint32_t i = 0; i < 2000; ++i) {
            PathSampler sampler(12, 0, i);
            const PathResult result = integrator.trace({{-4, 0.1, 0.2}, {1, 0, 0}}, 0.0, sampler);
            EXPECT_NEAR(seen(result, scene), 1.0, 1e-11);
            opacity = result.opacity;
        }
        if (medium == &thin) {
            EXPECT_LT(opacity, 0.1); // less than the throughput below which paths end at random
        } else {
            EXPECT_GT(opacity, 0.8);
        }
    }
}

TEST(PathClosedForms, mediaInEquilibriumAreInvisibleWhateverTheyAbsorb)
{
    // Kirchhoff: emission equal to absorption times the luminance around.
    MediumPoint point = substance(3.0, 0.6, PhaseFunction::henyeyGreenstein(0.5));
    point.emission = point.extinction - point.scattering;
    const HomogeneousMedium ball({MediumShape::Kind::Ball, {}, {1, 0, 0}}, point, true, 1.5);
    const WhiteSky sky;
    PathScene scene;
    scene.medium = &ball;
    scene.sky = &sky;
    const TraceRay ray{{-4, 0.1, 0.2}, {1, 0, 0}};
    const FlightEstimator local = FlightEstimator::LocalMajorants;
    const Statistics result = traced(scene, {.flight = local, .roulette = 0.0}, ray, 500);
    EXPECT_NEAR(result.mean(), 1.0, 1e-9);
    EXPECT_LT(result.variance(), 1e-12);
    for (const FlightEstimator flight : {FlightEstimator::Depth, local, FlightEstimator::Analog}) {
        const Statistics random = traced(scene, {.flight = flight, .roulette = 0.5}, ray, 20000);
        EXPECT_NEAR(random.mean(), 1.0, 3.0 * random.error());
    }
}

/// As bright as the cosine to the zenith; black below the horizon.
struct CosineSky final : PathSky
{
    glm::dvec3 luminance(const glm::dvec3& direction) const override
    {
        return glm::dvec3(std::max(0.0, direction.y));
    }
};

TEST(PathClosedForms, aDiffuseFloorReflectsItsIlluminance)
{
    // Under a sky of luminance cos(z): illuminance 2 pi / 3. Under a sun and a sky of 1: E cosine + pi.
    const auto tasks = base::makeSerialRunner();
    const std::vector<glm::vec3> positions{{-9, 0, -9}, {-9, 0, 9}, {9, 0, -9},
                                           {9, 0, -9},  {-9, 0, 9}, {9, 0, 9}};
    const std::vector<glm::vec3> normals(6, {0, 1, 0}), colors(6, {0.6f, 0.6f, 0.6f});
    TriangleScene triangles;
    PathScene scene;
    scene.mesh = {glm::dvec3(0.0), positions, normals, colors};
    triangles.build(scene.mesh, glm::dvec3(0.0), *tasks);
    scene.triangles = &triangles;
    const CosineSky cosine;
    scene.sky = &cosine;
    const double albedo = double(0.6f);
    const TraceRay ray{{1, 3, 0}, glm::normalize(glm::dvec3(0.1, -1, 0.2))};
    const Statistics sky = traced(scene, {}, ray, 20000);
    EXPECT_NEAR(sky.mean(), albedo * 2.0 / 3.0, 3.0 * sky.error());
    const WhiteSky white;
    const glm::dvec3 toSun = glm::normalize(glm::dvec3(0.5, 1.0, -0.2));
    const SunLight sun(toSun, glm::dvec3(4.0), 0.0);
    const std::array<const PathLight*, 1> lights{&sun};
    scene.sky = &white;
    scene.lights = lights;
    EXPECT_NEAR(traced(scene, {}, ray, 100).mean(), albedo * (4.0 * toSun.y / kPi + 1.0), 1e-9);
}

TEST(PathClosedForms, aLitBallReflectsAndTransmitsWhatOtherProgramsFound)
{
    struct Case
    {
        double albedo, g, sunward, far;
    };
    // Optical diameter 15; shares of the light that hits the ball, by the half of the surface where it
    // leaves.
    for (const Case& c :
         {Case{1.0, 0.7, 0.692, 0.308}, Case{0.99, 0.0, 0.825, 0.088}, Case{0.99, 0.7, 0.636, 0.272}})
    {
        const HomogeneousMedium ball({MediumShape::Kind::Ball, {}, {1, 0, 0}},
                                     substance(7.5, c.albedo, PhaseFunction::henyeyGreenstein(c.g)));
        MediumTracker tracker(&ball, FlightEstimator::Depth, ShadowEstimator::Exact);
        Statistics sunward, far;
        for (uint32_t i = 0; i < 60000; ++i) {
            PathSampler sampler(3, 0, i);
            const auto [area, turn] = sampler.pair();
            const double r = std::sqrt(area);
            const Escape out = escape(
                tracker, {{r * std::cos(2.0 * kPi * turn), 4.0, r * std::sin(2.0 * kPi * turn)}, {0, -1, 0}},
                sampler);
            const glm::dvec3 place =
                out.ray.origin + lengthInBall(out.ray.origin, out.ray.direction, 1.0) * out.ray.direction;
            // A path that was not scattered leaves through the far half.
            const bool isSunward = out.isOut && out.scatterings > 0 && place.y > 0.0;
            sunward.add(isSunward ? out.throughput.x : 0.0);
            far.add(out.isOut && !isSunward ? out.throughput.x : 0.0);
        }
        EXPECT_NEAR(sunward.mean(), c.sunward, 0.005) << c.albedo << ' ' << c.g;
        EXPECT_NEAR(far.mean(), c.far, 0.005) << c.albedo << ' ' << c.g;
    }
}

} // namespace
} // namespace fx::render
