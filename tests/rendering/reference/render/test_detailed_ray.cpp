// Rays through fields with detail: against the field point by point, against closed forms where detail
// changes nothing, and in thermal equilibrium.
#include "rendering/optics/black_body.h"
#include "rendering/reference/render/detailed_ray.h"
#include "rendering/reference/render/surface_light.h"
#include "tests/rendering/reference/render/detail_scenes.h"
#include "tests/rendering/reference/render/reference_scenes.h"

#include <cmath>
#include <limits>

using namespace fx;
using namespace fx::render;
using namespace fx::test;

namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();
constexpr double kTolerance = 1e-3;

const LumpTile& tile()
{
    static const LumpTile shared;
    return shared;
}

/// A medium, and rays along z through it.
struct Medium
{
    Medium(const Medium&) = delete;
    explicit Medium(const ReferenceScene& scene)
    {
        view.build(scene.blobs, scene.camera.eye, *base::makeSerialRunner(), scene.details,
                   PixelWidth(scene.camera, 200));
    }
    static TraceRay ray(int i) { return {{0.13 * (i % 5) - 0.25, 0.11 * (i / 5) - 0.2, 0.0}, {0, 0, -1}}; }
    const DetailedRay& traced(int i, double begin = 0.0, double end = kFar)
    {
        findHits(view.tree(), ray(i), begin, end, hits);
        detailed.trace(ray(i), hits, begin, end);
        return detailed;
    }
    MediumView view;
    RayHits hits;
    DetailedRay detailed{view, DetailedRay::Wanted::Light, kTolerance};
};

ReferenceScene detailScene(const FieldDetailNumbers& numbers, float temperature = 0.0f)
{
    ReferenceScene scene = blobScene(60, 2.0);
    scene.details = detailsOf(scene.blobs, numbers, temperature);
    return scene;
}

} // namespace

TEST(DetailedRay, isTheIntegralOfTheFieldPointByPoint)
{
    const ReferenceScene scene = detailScene(someDetail());
    const DetailedField field = fieldOf(scene.blobs, scene.details, tile());
    const double factor = double(scene.details.groups[0].detail.factor);
    const PixelWidth pixel(scene.camera, 200);
    Medium medium(scene);
    double least = 1.0, eroded = 0.0;
    for (int i = 0; i < 20; ++i) {
        const TraceRay ray = Medium::ray(i);
        const int steps = 8000;
        double depth = 0.0, smooth = 0.0;
        for (int k = 0; k < steps; ++k) {
            const glm::dvec3 p = ray.origin + ray.direction * (2.5 + 3.0 * (k + 0.5) / steps);
            const glm::vec3 world(p + scene.camera.eye);
            depth += factor * 3.0 / steps * double(field.extinctionAt(world, float(pixel.at(p))));
            smooth += 3.0 / steps * double(field.smoothAt(world).extinction);
        }
        EXPECT_NEAR(std::exp(-medium.traced(i).opticalDepth()), std::exp(-depth), 1.5 * kTolerance) << i;
        least = std::min(least, std::exp(-depth));
        eroded = std::max(eroded, std::abs(smooth - depth));
    }
    EXPECT_LT(least, 0.7);
    EXPECT_GT(eroded, 0.1);
}

TEST(DetailedRay, isTheClosedFormWhereDetailLeavesAll)
{
    FieldDetailNumbers numbers = someDetail();
    numbers.thinnest = 1e-12f;
    numbers.densest = 2e-12f;
    ReferenceScene scene = detailScene(numbers);
    scene.details.groups[0].detail.factor = 1.0f;
    const Rendered detailed(scene);
    scene.details = {};
    const Rendered smooth(scene);
    double brightest = 0.0;
    for (const float light : smooth[reference_channel::Color])
        brightest = std::max(brightest, double(light));
    for (uint32_t c = 0; c < reference_channel::Count; ++c)
        for (size_t i = 0; i < smooth[c].size(); ++i) {
            const bool isDepth = c == reference_channel::Depth;
            if (isDepth && smooth[c][i] == float(kFar))
                EXPECT_EQ(detailed[c][i], float(kFar));
            else
                EXPECT_NEAR(detailed[c][i], smooth[c][i], isDepth ? 0.03 : kTolerance * (1.0 + brightest))
                    << c;
        }
}

TEST(DetailedRay, depthsOfPartsAddUp)
{
    const ReferenceScene scene = detailScene(someDetail());
    Medium medium(scene);
    for (int i = 0; i < 20; ++i) {
        const DetailedRay& whole = medium.traced(i);
        const double depth = whole.opticalDepth(), first = whole.opticalDepth(0.0, 3.7),
                     second = whole.opticalDepth(3.7, 9.0);
        EXPECT_NEAR(first + second, depth, 1e-12);
        EXPECT_GE(first, 0.0);
        EXPECT_NEAR(medium.traced(i, 0.0, 3.7).opticalDepth(), first, 2.0 * kTolerance / std::exp(-depth));
    }
}

// What a medium of one temperature emits and what it lets pass are the furnace that it stands in.
TEST(DetailedRay, aFurnaceIsSeenThroughEveryBump)
{
    const glm::dvec3 planck(blackBodyLuminance(1500.0f));
    ReferenceScene scene = detailScene(someDetail(), 1500.0f);
    for (MediumBlob& blob : scene.blobs)
        blob.source = planck;
    Medium medium(scene);
    for (int i = 0; i < 20; ++i) {
        const DetailedRay& ray = medium.traced(i);
        const double passing = std::exp(-ray.opticalDepth());
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(ray.light()[c] + passing * planck[c], planck[c], 1e-4 * planck[c]);
    }
}

TEST(DetailedRay, opaqueMediumShowsPlancksSourceThoughItsSurfaceIsCooler)
{
    const glm::dvec3 planck(blackBodyLuminance(1500.0f));
    FieldDetailNumbers numbers = someDetail();
    numbers.cooling = 0.16f;
    numbers.glow = 0.09f;
    for (const double denser : {1.0, 1e9}) {
        ReferenceScene scene = detailScene(numbers, 1500.0f);
        for (MediumBlob& blob : scene.blobs) {
            blob.source = planck;
            blob.crossSection *= denser;
        }
        Medium medium(scene);
        double most = 0.0;
        for (int i = 0; i < 20; ++i) {
            const DetailedRay& ray = medium.traced(i);
            const double covered = -std::expm1(-ray.opticalDepth());
            most = std::max(most, std::abs(ray.light().x / (covered * planck.x) - 1.0));
        }
        if (denser > 1.0)
            EXPECT_LT(most, 0.02);
        else
            EXPECT_GT(most, 0.1) << "the control";
    }
}

TEST(DetailedRay, surfacesLieInTheShadowOfTheBumps)
{
    ReferenceScene scene = detailScene(someDetail());
    scene.opaque.lighting.sunDirection = {0.0f, 0.0f, -1.0f};
    scene.opaque.lighting.sunIlluminance = glm::vec3(1000.0f);
    const auto tasks = base::makeSerialRunner();
    Medium medium(scene);
    OpaqueView opaque;
    opaque.build(scene.opaque, scene.camera.eye, *tasks);
    SceneLights lights;
    lights.build(scene.opaque, scene.camera.eye, 1);
    SurfaceLight surface(medium.view, opaque, lights);
    for (int i = 0; i < 20; ++i) {
        const double passing = std::exp(-medium.traced(i).opticalDepth());
        EXPECT_NEAR(surface.at(Medium::ray(i).origin, {0, 0, -1}).x, 1000.0 * passing, 15.0);
    }
}

TEST(DetailedRay, scenesWithDetailHaveTheirOwnKeyAndAreChecked)
{
    const auto tasks = base::makeSerialRunner();
    ReferenceScene scene = detailScene(someDetail());
    ReferenceRenderer renderer;
    const auto key = [&] {
        EXPECT_TRUE(renderer.build(scene, smallSettings(), *tasks).ok());
        return renderer.key();
    };
    const uint64_t detailed = key();
    scene.details.groups[0].detail.numbers.fade = 0.36f;
    EXPECT_NE(key(), detailed);
    scene.details.balls[3].group = 1;
    EXPECT_FALSE(renderer.build(scene, smallSettings(), *tasks).ok());
    scene.details.balls.pop_back();
    scene.details.balls[3].group = -1;
    EXPECT_FALSE(renderer.build(scene, smallSettings(), *tasks).ok());
    scene.details = {};
    EXPECT_NE(key(), detailed);
}
