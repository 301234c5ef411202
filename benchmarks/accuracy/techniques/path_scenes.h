/// @file path_scenes.h
/// Media for the comparison of estimators by fx accuracy path.
#pragma once

#include "rendering/reference/path/blob_path_medium.h"
#include "rendering/reference/path/path_integrator.h"

#include <nlohmann/json.hpp>

#include <memory>
#include <optional>
#include <string>

namespace fx::cli {

/// Blobs of one size in a ball of radius 1 m around the origin, lit by the sun and a gray sky.
struct PathSceneParameters
{
    uint32_t blobs;
    double radius;       ///< [m]
    double opticalDepth; ///< [1] through the center
    double albedo;       ///< [1]
    double anisotropy;   ///< [1]
    bool isHot;          ///< true: every fifth blob is small, near the center and glowing; there is no sun
    int width, height;   ///< [pixel]
    uint32_t samples;    ///< samples per pixel, for the comparison of estimators
    uint32_t mostSamples, referenceSamples;
};

/// Looks up the parameters of a scene by name. @return nothing for an unknown name
std::optional<PathSceneParameters> pathSceneParameters(const std::string& name);

/// A scene and the rays of its picture.
class PathStage
{
public:
    explicit PathStage(const PathSceneParameters& parameters);

    const render::PathScene& scene() const { return scene_; }
    int pixels() const { return parameters_.width * parameters_.height; }
    /// The ray through a position within a pixel. @param x, y position in units of the pixel, [0, 1)
    render::TraceRay ray(int pixel, double x, double y) const;

private:
    struct Sky;

    PathSceneParameters parameters_;
    std::unique_ptr<base::TaskRunner> tasks_;
    std::unique_ptr<render::BlobPathMedium> medium_;
    render::SunLight sun_;
    const render::PathLight* lights_[1];
    std::shared_ptr<const render::PathSky> sky_;
    render::PathScene scene_;
};

} // namespace fx::cli
