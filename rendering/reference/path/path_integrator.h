/// @file path_integrator.h
/// Light along paths of any length through media and over surfaces, one random path at a time.
#pragma once

#include "rendering/reference/path/path_lights.h"
#include "rendering/reference/path/path_medium.h"
#include "rendering/reference/path/path_sampler.h"
#include "rendering/reference/render/triangle_scene.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <limits>
#include <memory>
#include <span>

namespace fx::render {

/// What paths go through. Members are owned by the caller; coordinates are those of the rays.
struct PathScene
{
    const PathMedium* medium = nullptr;       ///< may be null
    const TriangleScene* triangles = nullptr; ///< may be null; `mesh` holds their normals and colors
    OpaqueMesh mesh;
    std::span<const PathLight* const> lights;
    const PathSky* sky = nullptr; ///< null: black
};

/// How free paths are drawn, from the best to the textbook's, which the best are measured against.
enum class FlightEstimator : uint8_t
{
    LocalMajorants, ///< a majorant for each segment of MediumWalk
    OneMajorant     ///< the largest majorant of the ray for all of it: plain delta tracking [WMHL65]
};

/// How the transmittance towards lights is found.
enum class ShadowEstimator : uint8_t
{
    Exact, ///< the medium's own integral where it has one, otherwise ratio tracking
    Ratio, ///< product of the shares of null collisions [NSJ14]
    Delta  ///< 1 when a free path passes the light, otherwise 0
};

struct PathSettings
{
    uint32_t bounces = std::numeric_limits<uint32_t>::max(); ///< scatterings and reflections of a path
    FlightEstimator flight = FlightEstimator::LocalMajorants;
    ShadowEstimator shadow = ShadowEstimator::Exact;
    double roulette = 0.1; ///< [1] throughput below which paths end at random; 0: never
};

/// Where a free path ends.
struct Flight
{
    bool isScattered = false;
    double distance = 0.0; ///< [m] ray parameter of the scattering
    PhaseFunction phase;
};

struct PathResult
{
    glm::dvec3 luminance{0.0}; ///< [cd/m2]
    double opacity =
        0.0; ///< [1] 1 - transmittance of the eye's ray, 1 in front of a surface; mean of the channels
    bool sawBackground = false; ///< the ray from the eye met nothing: what stands behind is seen ...
    glm::dvec3 throughput{0.0}; ///< [1] ... by this share, and no light of the sky is in `luminance`
};

/// @formula spectral-tracking
/// An unbiased free path through a medium whose extinction differs between color channels.
///
/// symbol   unit   meaning
///   m        1/m    majorant of a segment, at least the extinction t_c of every channel c
///   s_c      1/m    scattering; n_c = m - t_c the null collisions
///   b_c      1      throughput of the path so far
///   P        1      probability that a tentative collision scatters
/// @derivation
///   distance to the next tentative collision: -ln(1 - u) / m; a segment that ends before hands on, free
///   paths have no memory                                                                                 (1)
///   P = S / (S + N), S = sum of b_c s_c, N = sum of b_c n_c                                        (2)
///   scattering: b_c <- b_c (s_c / m) / P;  null collision: b_c <- b_c (n_c / m) / (1 - P)          (3)
///   light emitted on the way: b_c e_c / m at every tentative collision                             (4)
/// @source    [KHLN17] Kutz et al., "Spectral and decomposition tracking for rendering heterogeneous
/// volumes",
///   doi:10.1145/3072959.3073665, for (1) to (3); (4) is its collision estimator
/// @deviation absorption is a weight in both branches of (3) instead of a third branch
/// @valid     any number of segments; m > 0
/// @accuracy  unbiased; weights never grow above the largest b_c
/// @tests     tests/rendering/reference/path/test_path_flight.cpp
///
/// One for each thread.
class PathIntegrator
{
public:
    /// @param scene what it points to must outlive this
    PathIntegrator(const PathScene& scene, const PathSettings& settings);

    /// One path from the eye.
    PathResult trace(const TraceRay& ray, double begin, PathSampler& sampler);

    /// One free path between two parameters of `ray`.
    /// @param io throughput, multiplied by what the way and the scattering leave
    /// @param outLuminance [cd/m2] light that the medium emitted on the way is added
    Flight fly(const TraceRay& ray, double begin, double end, PathSampler& sampler, glm::dvec3& io,
               glm::dvec3& outLuminance);
    /// Transmittance of the medium between two parameters, or an estimate without bias.
    glm::dvec3 transmittance(const TraceRay& ray, double begin, double end, PathSampler& sampler);

    uint64_t collisions() const { return collisions_; } ///< tentative ones so far, as a measure of work

private:
    SurfaceHit surface(const TraceRay& ray, double begin);
    /// [lx] of a light, behind what stands between.
    glm::dvec3 arriving(const LightSample& sample, const glm::dvec3& position, PathSampler& sampler);
    glm::dvec3 lightAt(const glm::dvec3& position, const glm::dvec3& direction, const PhaseFunction& phase,
                       PathSampler& sampler);
    /// Continues `ray` above the surface that it met.
    void reflect(const SurfaceHit& hit, TraceRay& ray, PathSampler& sampler, glm::dvec3& io,
                 glm::dvec3& outLuminance);

    PathScene scene_;
    PathSettings settings_;
    std::unique_ptr<MediumWalk> walk_, shadowWalk_;
    RayHits hits_;
    uint64_t collisions_ = 0;
};

} // namespace fx::render
