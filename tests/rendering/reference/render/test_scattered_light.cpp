/// Light that is scattered once, against cases that can be worked out by hand.

#include "rendering/reference/render/scattered_light.h"

#include "rendering/optics/phase.h"
#include "rendering/reference/blob_medium/blob_medium.h"
#include "rendering/reference/trace/ray_query.h"
#include "tests/rendering/reference/render/reference_scenes.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace fx::render {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();

MediumBlob blobAt(const glm::dvec3& center, double radius, double crossSection)
{
    MediumBlob blob;
    blob.center = center;
    blob.radius = radius;
    blob.crossSection = crossSection;
    blob.albedo = {1.0, 0.5, 0.0};
    return blob;
}

/// Light along -Z from the origin.
ScatteredLight::Layers scatteredBy(const std::vector<MediumBlob>& blobs, const OpaqueScene& scene,
                                   double end = kInf, int skyRings = 4)
{
    const auto tasks = base::makeSerialRunner();
    MediumView medium;
    medium.build(blobs, glm::dvec3(0.0), *tasks);
    OpaqueView opaque;
    opaque.build(scene, glm::dvec3(0.0), *tasks);
    const TraceRay ray{glm::dvec3(0.0), {0.0, 0.0, -1.0}};
    RayHits hits;
    findHits(medium.tree(), ray, 0.0, end, hits);
    SceneLights lights;
    lights.build(scene, glm::dvec3(0.0), skyRings);
    return ScatteredLight(medium, opaque, lights).along(ray, hits, 0.0, end);
}

OpaqueScene underSun(const glm::vec3& direction)
{
    OpaqueScene scene;
    scene.lighting.sunDirection = direction;
    scene.lighting.sunIlluminance = {100.0f, 100.0f, 100.0f};
    scene.lighting.groundAlbedo = 0.0f;
    return scene;
}

TEST(ScatteredLight, aThinBlobScattersItsOpticalDepthTimesTheAlbedo)
{
    MediumBlob blob = blobAt({0.0, 0.0, -10.0}, 1.0, 1e-4);
    blob.anisotropy = 0.4;
    const auto light = scatteredBy({blob}, underSun({0.0f, 0.8f, 0.6f}));
    const double depth = 3.5 / std::numbers::pi * 1e-4;
    const double expected = 100.0 * depth * double(henyeyGreenstein(-0.6f, 0.4f));
    EXPECT_NEAR(light[1].x, expected, 3e-4 * expected);
    EXPECT_NEAR(light[1].y, 0.5 * expected, 3e-4 * expected);
    EXPECT_EQ(light[1].z, 0.0);
    EXPECT_EQ(light[0], glm::dvec3(0.0));
}

TEST(ScatteredLight, theSunBehindTheEyeMeetsTheSameMediumGoingAndComing)
{
    // Both ways have the optical depth x: the integral of exp(-2 x) dx = (1 - exp(-2 tau)) / 2.
    for (const double crossSection : {0.1, 1.0, 5.0}) {
        const auto light =
            scatteredBy({blobAt({0.0, 0.0, -10.0}, 1.0, crossSection)}, underSun({0.0f, 0.0f, 1.0f}));
        const double depth = 3.5 / std::numbers::pi * crossSection;
        const double expected = 100.0 / (4.0 * std::numbers::pi) * 0.5 * (1.0 - std::exp(-2.0 * depth));
        EXPECT_NEAR(light[1].x, expected, 2e-3 * expected) << depth;
    }
}

TEST(ScatteredLight, lookingIntoTheSunEveryPathHasTheWholeDepth)
{
    const double depth = 3.5 / std::numbers::pi * 2.0;
    const auto light = scatteredBy({blobAt({0.0, 0.0, -10.0}, 1.0, 2.0)}, underSun({0.0f, 0.0f, -1.0f}));
    const double expected = 100.0 / (4.0 * std::numbers::pi) * depth * std::exp(-depth);
    EXPECT_NEAR(light[1].x, expected, 1e-3 * expected);
}

TEST(ScatteredLight, aBlobCastsItsShadowOnAnother)
{
    const MediumBlob lit = blobAt({0.0, 0.0, -10.0}, 0.1, 1e-6);
    const MediumBlob between = blobAt({0.0, 5.0, -10.0}, 1.0, 2.0);
    const auto open = scatteredBy({lit}, underSun({0.0f, 1.0f, 0.0f}));
    const auto shaded = scatteredBy({lit, between}, underSun({0.0f, 1.0f, 0.0f}));
    const double depth = 3.5 / std::numbers::pi * 2.0;
    EXPECT_NEAR(shaded[1].x / open[1].x, std::exp(-depth),
                0.03 * std::exp(-depth)); // off its middle it is thinner
}

TEST(ScatteredLight, trianglesCastShadowsAndEndTheRay)
{
    const std::vector<glm::vec3> roof{{-9, 3, 9}, {9, 3, 9}, {0, 3, -90}};
    const std::vector<glm::vec3> up(3, {0, 1, 0});
    OpaqueScene scene = underSun({0.0f, 1.0f, 0.0f});
    const MediumBlob blob = blobAt({0.0, 0.0, -10.0}, 1.0, 1e-4);
    EXPECT_GT(scatteredBy({blob}, scene)[1].x, 0.0);
    EXPECT_NEAR(scatteredBy({blob}, scene, 10.0)[1].x, 0.5 * scatteredBy({blob}, scene)[1].x, 1e-4);
    scene.mesh = {glm::dvec3(0.0), roof, up, up};
    EXPECT_EQ(scatteredBy({blob}, scene)[1].x, 0.0);
}

TEST(ScatteredLight, aGlowingGroupIsALightOfItsDistance)
{
    OpaqueScene scene;
    scene.lights.push_back({glm::dvec3(0.0, 3.0, -10.0), glm::vec3(90.0f), 0.5f});
    const MediumBlob blob = blobAt({0.0, 0.0, -10.0}, 0.01, 1e-9);
    const double depth = 3.5 / std::numbers::pi * 1e-9 / 1e-4;
    const double expected = 90.0 / (9.0 + 0.25) / (4.0 * std::numbers::pi) * depth;
    EXPECT_NEAR(scatteredBy({blob}, scene)[1].x, expected, 1e-3 * expected);
}

OpaqueScene withLamp(const glm::dvec3& position, float radius = 0.0f)
{
    OpaqueScene scene;
    SceneLight lamp;
    lamp.position = position;
    lamp.intensity = glm::vec3(40.0f);
    lamp.radius = radius;
    scene.lamps.push_back(lamp);
    return scene;
}

TEST(ScatteredLight, theRadialTransmittanceFromAPointInTheMiddleOfABlobIsExact)
{
    // Collisions of the light of a point within r: the integral of extinction times transmittance is
    // 1 - T(r), and T is that of half a chord at the rim.
    const auto tasks = base::makeSerialRunner();
    for (const double crossSection : {0.3, 3.0, 20.0}) {
        MediumView medium;
        medium.build({{blobAt({0.0, 0.0, -5.0}, 2.0, crossSection)}}, glm::dvec3(0.0), *tasks);
        OpaqueView opaque;
        opaque.build({}, glm::dvec3(0.0), *tasks);
        ShadowRay shadow(medium, opaque);
        const glm::dvec3 center(0.0, 0.0, -5.0), out = glm::normalize(glm::dvec3(1.0, 2.0, -0.5));
        const double peak = 105.0 * crossSection / (32.0 * std::numbers::pi * 8.0);
        double collided = 0.0;
        constexpr int kSteps = 2000;
        for (int k = 0; k < kSteps; ++k) {
            const double r = 2.0 * (k + 0.5) / kSteps;
            const double q = 1.0 - r * r / 4.0;
            collided += peak * q * q * shadow.visibility({center + r * out, -out}, r) * 2.0 / kSteps;
        }
        const double half = 0.5 * 3.5 / std::numbers::pi * crossSection / 4.0;
        EXPECT_NEAR(collided, 1.0 - std::exp(-half), 1e-5);
    }
}

TEST(ScatteredLight, aPointInTheMiddleOfABlobLightsItAsTheRadialIntegralSays)
{
    // The ray passes the light at the distance b. Counted by the angle, dt / r^2 = da / b.
    for (const double b : {0.5, 0.05, 1e-3}) {
        for (const double crossSection : {0.1, 2.0, 10.0}) {
            const double radius = 1.0;
            const double peak = 105.0 * crossSection / (32.0 * std::numbers::pi);
            const auto outwards = [&](double r) { // optical depth from the center
                return peak * (r - 2.0 / 3.0 * r * r * r + 0.2 * r * r * r * r * r);
            };
            const double half = std::sqrt(radius * radius - b * b);
            const double h2 = half * half;
            const auto alongRay = [&](double s) { // from the middle of the chord
                return peak * (h2 * h2 * s - 2.0 / 3.0 * h2 * s * s * s + 0.2 * s * s * s * s * s);
            };
            double expected = 0.0;
            constexpr int kSteps = 20000;
            const double rim = std::atan(half / b);
            for (int k = 0; k < kSteps; ++k) {
                const double s = b * std::tan(rim * (2.0 * (k + 0.5) / kSteps - 1.0));
                const double r = std::sqrt(b * b + s * s);
                const double q = 1.0 - r * r;
                expected += peak * q * q * std::exp(-outwards(r) - alongRay(s) - alongRay(half));
            }
            expected *= 2.0 * rim / kSteps / b * 40.0 / (4.0 * std::numbers::pi);
            const auto light =
                scatteredBy({blobAt({0.0, b, -10.0}, radius, crossSection)}, withLamp({0.0, b, -10.0}));
            EXPECT_NEAR(light[1].x, expected, 2e-4 * expected) << b << ' ' << crossSection;
        }
    }
}

TEST(ScatteredLight, onlyTheMediumInsideTheConeOfASpotIsLit)
{
    OpaqueScene scene = withLamp({0.0, 4.0, -10.0});
    scene.lamps[0].innerAngle = scene.lamps[0].outerAngle = std::atan(0.5f);
    // The cone meets the ray from -12 to -8. Extinction of a thin blob in it: half + half of the middle.
    const MediumBlob wide = blobAt({0.0, 0.0, -10.0}, 4.0, 1e-6);
    const double peak = 105.0 * 1e-6 / (32.0 * std::numbers::pi * 64.0);
    double expected = 0.0;
    constexpr int kSteps = 10000;
    for (int k = 0; k < kSteps; ++k) {
        const double s = 4.0 * (k + 0.5) / kSteps - 2.0;
        const double q = 1.0 - s * s / 16.0;
        expected += peak * q * q / (16.0 + s * s);
    }
    expected *= 4.0 / kSteps * 40.0 / (4.0 * std::numbers::pi);
    EXPECT_NEAR(scatteredBy({wide}, scene)[1].x, expected, 1e-5 * expected);
    EXPECT_EQ(scatteredBy({blobAt({0.0, 0.0, -5.0}, 2.9, 1e-6)}, scene)[1].x, 0.0);
}

TEST(ScatteredLight, aBallLightsAsAPointFromOutsideAndFromAllSidesWithin)
{
    const MediumBlob blob = blobAt({0.0, 0.0, -10.0}, 0.01, 1e-9);
    const double depth = 3.5 / std::numbers::pi * 1e-9 / 1e-4;
    for (const float radius : {0.0f, 0.1f, 2.0f}) {
        const double below =
            radius > 0.0f ? radius * radius / 9.0 / (1.0 + std::sqrt(1.0 - radius * radius / 9.0)) : 0.0;
        const double luminance = radius > 0.0f ? 40.0 / (std::numbers::pi * radius * radius) : 0.0;
        const double fluence = radius > 0.0f ? luminance * 2.0 * std::numbers::pi * below : 40.0 / 9.0;
        const double expected = fluence / (4.0 * std::numbers::pi) * depth;
        EXPECT_NEAR(scatteredBy({blob}, withLamp({0.0, 3.0, -10.0}, radius))[1].x, expected, 1e-4 * expected);
    }
    const double within = 40.0 / (std::numbers::pi * 16.0) * depth;
    EXPECT_NEAR(scatteredBy({blob}, withLamp({0.0, 3.0, -10.0}, 4.0f))[1].x, within, 1e-4 * within);
}

TEST(ScatteredLight, anEvenSkyAroundAThinBlobIsSeenInItWhateverThePhase)
{
    OpaqueScene scene;
    scene.lighting.skyLuminance = glm::vec3(80.0f);
    scene.lighting.groundAlbedo = 1.0f;
    for (const double g : {0.0, 0.7, -0.9})
        for (const int rings : {1, 4}) {
            MediumBlob blob = blobAt({0.0, 0.0, -10.0}, 1.0, 1e-6);
            blob.anisotropy = g;
            const double depth = 3.5 / std::numbers::pi * 1e-6;
            EXPECT_NEAR(scatteredBy({blob}, scene, kInf, rings)[1].x, 80.0 * depth, 1e-4 * 80.0 * depth);
        }
}

TEST(ScatteredLight, halfASkyAndAHorizonAreScatteredByThePhaseFunction)
{
    // Looking along the horizon, either half of the sky sends half, whatever the phase function.
    OpaqueScene scene;
    scene.lighting.skyLuminance = glm::vec3(80.0f);
    scene.lighting.groundAlbedo = 0.0f;
    for (const double g : {0.0, 0.7}) {
        MediumBlob blob = blobAt({0.0, 0.0, -10.0}, 1.0, 1e-6);
        blob.anisotropy = g;
        const double expected = 40.0 * 3.5 / std::numbers::pi * 1e-6;
        EXPECT_NEAR(scatteredBy({blob}, scene)[1].x, expected, 1e-3 * expected);
    }
}

TEST(ScatteredLight, aShellDimsTheSkyByItsTransmittanceInAllDirections)
{
    OpaqueScene scene;
    scene.lighting.skyLuminance = glm::vec3(80.0f);
    scene.lighting.groundAlbedo = 1.0f;
    const MediumBlob seen = blobAt({0.0, 0.0, -10.0}, 0.01, 1e-9);
    MediumBlob shell = blobAt({0.0, 0.0, -10.0}, 4.0, 16.0);
    shell.albedo = glm::dvec3(0.0);
    const double alone = scatteredBy({seen}, scene)[1].x;
    const double half = 0.5 * 3.5 / std::numbers::pi;
    // dimmed on the way in and once more on the way to the eye
    EXPECT_NEAR(scatteredBy({seen, shell}, scene)[1].x / alone, std::exp(-2.0 * half), 1e-3);
}

/// Root mean square over rays through different clouds of 60 blobs.
double errorOfTheSky(int skyRings)
{
    OpaqueScene scene;
    scene.lighting.skyLuminance = glm::vec3(80.0f);
    scene.lighting.groundAlbedo = 0.2f;
    double squares = 0.0;
    constexpr int kClouds = 12;
    for (int cloud = 0; cloud < kClouds; ++cloud) {
        test::Chance chance(uint64_t(cloud) + 8);
        std::vector<MediumBlob> blobs;
        for (int i = 0; i < 60; ++i) {
            blobs.push_back(blobAt(glm::dvec3(0.0, 0.0, -10.0) + 1.2 * chance.inCube(),
                                   chance.between(0.3, 0.9), 0.2 * chance()));
            blobs.back().anisotropy = 0.5;
        }
        static std::array<double, kClouds> exact{};
        if (exact[size_t(cloud)] == 0.0)
            exact[size_t(cloud)] = scatteredBy(blobs, scene, kInf, 14)[1].x;
        const double error = scatteredBy(blobs, scene, kInf, skyRings)[1].x / exact[size_t(cloud)] - 1.0;
        squares += error * error / kClouds;
    }
    return std::sqrt(squares);
}

TEST(ScatteredLight, theErrorOfTheSkyFallsWithTheNumberOfDirections)
{
    EXPECT_LT(errorOfTheSky(2), 0.03);
    EXPECT_LT(errorOfTheSky(3), 0.015);
    EXPECT_LT(errorOfTheSky(4), 0.0125);
    EXPECT_LT(errorOfTheSky(6), 0.005);
}

/// Summed in small steps, every shadow by looking at every blob.
double marchedScattering(const std::vector<MediumBlob>& blobs, const glm::dvec3& sun, double begin,
                         double end)
{
    std::vector<Blob> same;
    for (const MediumBlob& blob : blobs)
        same.push_back({blob.center, blob.radius, blob.crossSection, {}});
    const BlobMedium medium(same);
    const Ray ray{glm::dvec3(0.0), {0.0, 0.0, -1.0}};
    const int steps = 1500;
    double sum = 0.0;
    for (int k = 0; k < steps; ++k) {
        const double t = begin + (end - begin) * (k + 0.5) / steps;
        const glm::dvec3 point = ray.direction * t;
        const double depth = medium.opticalDepth(ray, 0.0, t) + medium.opticalDepth({point, sun}, 0.0, 1e3);
        sum += medium.extinctionAt(point) * std::exp(-depth);
    }
    return sum * (end - begin) / steps * 100.0 / (4.0 * std::numbers::pi);
}

TEST(ScatteredLight, manyOverlappingBlobsAreWithinTheBoundOfAFineSum)
{
    test::Chance chance(8);
    const glm::dvec3 sun = glm::normalize(glm::dvec3(0.3, 0.8, 0.4));
    for (const double crossSection : {0.02, 0.2, 1.0}) {
        std::vector<MediumBlob> blobs;
        for (int i = 0; i < 60; ++i)
            blobs.push_back(blobAt(glm::dvec3(0.0, 0.0, -10.0) + 1.2 * chance.inCube(),
                                   chance.between(0.3, 0.9), crossSection * chance()));
        const double expected = marchedScattering(blobs, sun, 7.5, 12.5);
        EXPECT_NEAR(scatteredBy(blobs, underSun(glm::vec3(sun)))[1].x, expected, 2e-3 * expected);
    }
}

} // namespace
} // namespace fx::render
