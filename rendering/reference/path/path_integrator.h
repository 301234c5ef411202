/// @file path_integrator.h
/// Computes the light along random paths of any length through media and over surfaces.
#pragma once

#include "rendering/reference/path/path_lights.h"
#include "rendering/reference/path/path_tracking.h"
#include "rendering/reference/render/medium_details.h"
#include "rendering/reference/render/triangle_scene.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <limits>
#include <span>

namespace fx::render {

/// The scene of the path tracer. The caller owns the objects to which the members point. The objects and the
/// rays use the same coordinates.
struct PathScene
{
    const PathMedium* medium = nullptr; ///< may be null
    /// Triangles; may be null. `mesh` has their normals and colors.
    const TriangleScene* triangles = nullptr;
    OpaqueMesh mesh;
    glm::dvec3 eye{0.0}; ///< [m] world position to which rays are relative
    PixelWidth pixel;    ///< width of a pixel, over which soil that camera rays hit is averaged
    std::span<const PathLight* const> lights;
    const PathSky* sky = nullptr; ///< null: no light
};

struct PathSettings
{
    /// Largest number of scatterings and reflections of a path.
    uint32_t bounces = std::numeric_limits<uint32_t>::max();
    FlightEstimator flight = FlightEstimator::Depth;
    ShadowEstimator shadow = ShadowEstimator::Exact;

    /// Number of flights (free paths) at the beginning of a path in which a collision is forced. The flight
    /// is weighted by the fraction of light that collides; the remaining light escapes to the sky. Collisions
    /// are forced only with FlightEstimator::Depth, and only in flights that do not end at a surface.
    uint32_t forcedFlights = 1;

    /// [1] Threshold of Russian roulette: paths with a lower throughput end at random. The threshold is
    /// relative to the fraction of light that remains after forced collisions. 0: no roulette.
    double roulette = 0.1;
};

struct PathResult
{
    glm::dvec3 luminance{0.0}; ///< [cd/m2]
    /// [1] Opacity of the camera ray: 1 - transmittance, as a mean of the channels; or 1 if the ray hits a
    /// surface.
    double opacity = 0.0;
    bool sawBackground = false; ///< true: the camera ray hit no surface, so that the background is visible
    /// [1] Transmittance to the background; valid if sawBackground is true. If sawBackground is true,
    /// `luminance` does not include light of the sky.
    glm::dvec3 throughput{0.0};
};

/// Traces random paths. Each thread needs its own object.
class PathIntegrator
{
public:
    /// @param scene scene whose objects must outlive the integrator
    PathIntegrator(const PathScene& scene, const PathSettings& settings);

    /// Traces one path from the eye.
    /// @param begin [m] ray parameter at which the path begins
    PathResult trace(const TraceRay& ray, double begin, PathSampler& sampler);

    /// Number of tentative collisions so far, as a measure of work
    uint64_t collisions() const { return tracker_.collisions(); }

private:
    struct Way
    {
        FlightStart start;
        Flight flight;
    };

    /// A place of a surface that reflects light.
    struct SurfacePoint
    {
        double distance = 0.0; ///< [m] along the ray
        glm::dvec3 normal{0.0, 1.0, 0.0}, albedo{0.0};
    };

    SurfaceHit surface(const TraceRay& ray, double begin);
    /// @param isSeen true: a camera ray; false: the relief of soil is not evaluated, its mean is
    SurfacePoint surfaceAt(const SurfaceHit& hit, const TraceRay& ray, bool isSeen) const;
    /// [lx] Illuminance by a light sample, attenuated by media and surfaces.
    glm::dvec3 arriving(const LightSample& sample, const glm::dvec3& position, PathSampler& sampler);

    /// Light from the light sources that is scattered at the end of a path segment.
    glm::dvec3 lightAt(const Way& way, PathSampler& sampler);
    /// [1/m] Probability density of a collision at a ray parameter of `way`, which must be the last flight
    /// that was sampled by optical depth.
    double collisionDensity(const Way& way, double parameter) const;
    /// Light from nearby light sources that is scattered anywhere on a path segment. One point on the segment
    /// is sampled for each light.
    glm::dvec3 lightOnWay(const Way& way, PathSampler& sampler);
    /// Light emitted by the medium that arrives at a point and is scattered there.
    /// @param density [1/sr] probability density of the next flight's direction, which equals the fraction of
    ///         light that is scattered to this direction
    template <class Density>
    glm::dvec3 emissionAt(const glm::dvec3& position, const Density& density, PathSampler& sampler);
    /// Scatters light at the end of a segment: returns the scattered light, and samples the next direction.
    glm::dvec3 scatter(const Way& way, PathSampler& sampler, FlightStart& outNext);
    /// [1] Opacity along the camera ray, up to infinity.
    double opacity(const Way& way, PathSampler& sampler);
    /// Applies Russian roulette: ends paths of low throughput at random, and increases the weight of the
    /// surviving paths.
    /// @param least [1] throughput below which paths may end
    /// @return false if the path ends
    static bool survives(double least, glm::dvec3& io, PathSampler& sampler);
    /// Reflects light at a surface: adds the reflected light of light sources, and samples the next
    /// direction.
    void reflect(const SurfacePoint& surface, const TraceRay& ray, PathSampler& sampler, FlightStart& outNext,
                 glm::dvec3& io, glm::dvec3& outLuminance);

    PathScene scene_;
    PathSettings settings_;
    MediumTracker tracker_;
    RayHits hits_;
};

} // namespace fx::render
