/// @file reference_scenes.h
/// Small scenes and pictures for the tests of this folder.
#pragma once

#include "rendering/reference/render/reference_renderer.h"
#include "tests/rendering/reference/trace/ball_scenes.h"

#include <gtest/gtest.h>

#include <vector>

namespace fx::test {

/// Overlapping blobs of random emission in a ball of radius 1 m. The camera distance is 4 m, and the
/// background is empty.
inline render::ReferenceScene blobScene(size_t count, double opticalDepth, uint64_t seed = 1)
{
    Chance chance(seed);
    render::ReferenceScene scene;
    while (scene.blobs.size() < count) {
        render::MediumBlob blob;
        blob.center = chance.inCube();
        if (glm::dot(blob.center, blob.center) > 1.0)
            continue;
        blob.radius = chance.between(0.1, 0.5);
        blob.crossSection = opticalDepth * 3.0 / double(count) * chance.between(0.2, 1.0);
        blob.source = {chance(), chance(), chance()};
        blob.fireShare = chance();
        scene.blobs.push_back(blob);
    }
    scene.opaque.isEmpty = true;
    scene.camera = render::ReferenceCamera::lookAt({0.0, 0.0, 4.0}, glm::dvec3(0.0), {0.0, 1.0, 0.0});
    scene.camera.halfHeight = 0.35;
    return scene;
}

inline render::ReferenceSettings smallSettings()
{
    render::ReferenceSettings settings;
    settings.width = 42; // not a multiple of any tile
    settings.height = 27;
    return settings;
}

/// A finished picture.
struct Rendered
{
    explicit Rendered(const render::ReferenceScene& scene,
                      const render::ReferenceSettings& settings = smallSettings(), uint32_t threads = 1)
    {
        const auto tasks = threads == 1 ? base::makeSerialRunner() : base::makeTbbRunner(threads);
        const base::Status built = renderer.build(scene, settings, *tasks);
        EXPECT_TRUE(built.ok()) << built.message();
        EXPECT_TRUE(renderer.render(nullptr, {}).ok());
    }
    const std::vector<float>& operator[](uint32_t channel) const { return renderer.pixels(channel); }

    render::ReferenceRenderer renderer;
};

} // namespace fx::test
