/// @file path_integrator.h
/// Light along paths of any length through media and over surfaces, one random path at a time.
#pragma once

#include "rendering/reference/path/path_lights.h"
#include "rendering/reference/path/path_tracking.h"
#include "rendering/reference/render/triangle_scene.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <limits>
#include <span>

namespace fx::render {

/// Scene of the paths. Members are owned by the caller; coordinates are those of the rays.
struct PathScene
{
    const PathMedium* medium = nullptr;       ///< may be null
    const TriangleScene* triangles = nullptr; ///< may be null; `mesh` holds their normals and colors
    OpaqueMesh mesh;
    std::span<const PathLight* const> lights;
    const PathSky* sky = nullptr; ///< null: black
};

struct PathSettings
{
    uint32_t bounces = std::numeric_limits<uint32_t>::max(); ///< scatterings and reflections of a path
    FlightEstimator flight = FlightEstimator::Depth;
    ShadowEstimator shadow = ShadowEstimator::Exact;

    /// Number of flights at the beginning of a path in which a collision is forced. Such a flight carries the
    /// share of light that collides; the remaining light reaches the sky. Only flights by depth that end at
    /// no surface.
    uint32_t forcedFlights = 1;

    /// [1] throughput below which paths end at random, relative to the share of light that forced collisions
    /// left; 0: never
    double roulette = 0.1;
};

struct PathResult
{
    glm::dvec3 luminance{0.0}; ///< [cd/m2]
    /// [1] 1 - transmittance of the eye's ray, 1 in front of a surface; mean of the channels
    double opacity = 0.0;
    bool sawBackground = false; ///< the camera ray hit nothing: the background is visible ...
    glm::dvec3 throughput{0.0}; ///< [1] ... by this share, and no light of the sky is in `luminance`
};

/// One for each thread.
class PathIntegrator
{
public:
    /// @param scene its objects must outlive this
    PathIntegrator(const PathScene& scene, const PathSettings& settings);

    /// One path from the eye.
    PathResult trace(const TraceRay& ray, double begin, PathSampler& sampler);

    /// tentative ones so far, as a measure of work
    uint64_t collisions() const { return tracker_.collisions(); }

private:
    struct Way
    {
        FlightStart start;
        Flight flight;
    };

    SurfaceHit surface(const TraceRay& ray, double begin);
    /// [lx] of a light, attenuated by occluders.
    glm::dvec3 arriving(const LightSample& sample, const glm::dvec3& position, PathSampler& sampler);

    /// Light that is scattered at the end of a way.
    glm::dvec3 lightAt(const Way& way, PathSampler& sampler);
    /// [1/m] with which the last way, which is `way`, collides at a parameter; only by depth.
    double collisionDensity(const Way& way, double parameter) const;
    /// Light of lights near the way that is scattered anywhere on it, by a place drawn for each of them.
    glm::dvec3 lightOnWay(const Way& way, PathSampler& sampler);
    /// Light of the medium itself that arrives at a place; `density` [1/sr] is that of the next flight's
    /// direction, which is also the share of light that leaves in this direction.
    template <class Density>
    glm::dvec3 emissionAt(const glm::dvec3& position, const Density& density, PathSampler& sampler);
    /// Light that is scattered at the end of a way, and the direction after it.
    glm::dvec3 scatter(const Way& way, PathSampler& sampler, FlightStart& outNext);
    /// [1] of the way of the eye's ray to infinity.
    double opacity(const Way& way, PathSampler& sampler);
    /// Russian roulette: ends paths of low throughput at random, and weights the surviving ones accordingly.
    /// @param least [1] throughput below which it is applied
    static bool survives(double least, glm::dvec3& io, PathSampler& sampler);
    /// Continues above the surface that a way met.
    void reflect(const SurfaceHit& hit, const TraceRay& ray, PathSampler& sampler, FlightStart& outNext,
                 glm::dvec3& io, glm::dvec3& outLuminance);

    PathScene scene_;
    PathSettings settings_;
    MediumTracker tracker_;
    RayHits hits_;
};

} // namespace fx::render
