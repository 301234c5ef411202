#include "benchmarks/accuracy/techniques/path_scenes.h"

#include "foundation/random/philox.h"

#include <glm/geometric.hpp>

#include <cmath>
#include <numbers>
#include <vector>

namespace fx::cli {
namespace {

constexpr double kEye = 4.0;   // [m] from the middle
constexpr double kField = 2.6; // [m] height of what is seen there

/// Number k of blob i, 0..1.
double random(uint32_t i, uint32_t k)
{
    return double(base::toUnitFloat(base::philox({i, k / 4, 0, 0}, 270)[k % 4]));
}

std::vector<render::MediumBlob> blobsOf(const PathSceneParameters& p)
{
    std::vector<render::MediumBlob> blobs;
    double depth = 0.0; // through the middle, for a cross section of 1
    for (uint32_t i = 0; blobs.size() < p.blobs; ++i) {
        const glm::dvec3 place(2.0 * random(i, 0) - 1.0, 2.0 * random(i, 1) - 1.0, 2.0 * random(i, 2) - 1.0);
        if (glm::dot(place, place) > 1.0)
            continue;
        render::MediumBlob blob;
        blob.center = place;
        blob.radius = p.radius;
        blob.albedo = glm::dvec3(p.albedo);
        blob.anisotropy = p.anisotropy;
        const double chord2 = p.radius * p.radius - place.x * place.x - place.y * place.y;
        if (chord2 > 0.0)
            depth += 3.5 / std::numbers::pi * std::pow(chord2, 2.5) / std::pow(p.radius, 7.0);
        blobs.push_back(blob);
    }
    for (uint32_t i = 0; i < blobs.size(); ++i) {
        render::MediumBlob& blob = blobs[i];
        blob.crossSection = p.opticalDepth / depth;
        if (!p.isHot || i % 5 != 0)
            continue;
        blob.center *= 0.4;
        blob.radius *= 0.5;
        blob.crossSection *= 0.3;
        blob.albedo = glm::dvec3(0.2);
        blob.source = glm::dvec3(50.0 * std::pow(random(i, 3), 3.0));
    }
    return blobs;
}

} // namespace

struct PathStage::Sky final : render::PathSky
{
    glm::dvec3 luminance(const glm::dvec3& direction) const override
    {
        return glm::dvec3(direction.y >= 0.0 ? 0.2 : 0.05);
    }
};

std::optional<PathSceneParameters> pathSceneParameters(const std::string& name)
{
    const PathSceneParameters thin{270, 0.3, 2.0, 0.9, 0.5, false, 24, 24, 64, 256, 4096};
    if (name == "blobs-270")
        return thin;
    if (name == "cloud")
        return PathSceneParameters{2000, 0.2, 40.0, 0.999, 0.7, false, 12, 12, 64, 256, 2048};
    if (name == "fire")
        return PathSceneParameters{300, 0.3, 5.0, 0.8, 0.3, true, 24, 24, 64, 256, 4096};
    PathSceneParameters small = thin;
    small.width = small.height = 12;
    small.referenceSamples = 2048;
    return name == "blobs-270-small" ? std::optional(small) : std::nullopt;
}

PathStage::PathStage(const PathSceneParameters& parameters)
    : parameters_(parameters), tasks_(base::makeSerialRunner()),
      sun_(glm::normalize(glm::dvec3(0.4, 0.8, 0.3)), glm::dvec3(3.0), 0.00465), lights_{&sun_},
      sky_(std::make_shared<Sky>())
{
    medium_ = std::make_unique<render::BlobPathMedium>(blobsOf(parameters), glm::dvec3(0.0), *tasks_);
    scene_.medium = medium_.get();
    scene_.sky = sky_.get();
    if (!parameters.isHot)
        scene_.lights = lights_;
}

render::TraceRay PathStage::ray(int pixel, double x, double y) const
{
    const double column = pixel % parameters_.width + x - 0.5 * parameters_.width;
    const double row = pixel / parameters_.width + y - 0.5 * parameters_.height;
    const double size = kField / parameters_.height;
    return {{0.0, 0.0, kEye}, glm::normalize(glm::dvec3(column * size, -row * size, -kEye))};
}

} // namespace fx::cli
