/// @file path_tracking.h
/// Free paths of light through a medium, the light that the medium emits on the way, and transmittances.
#pragma once

#include "rendering/reference/path/path_medium.h"
#include "rendering/reference/path/path_sampler.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <limits>
#include <memory>

namespace fx::render {

/// How free paths are drawn.
enum class FlightEstimator : uint8_t
{
    Depth,          ///< by the inverse of the optical depth where the medium has one, or by local majorants
    LocalMajorants, ///< by null collisions with a majorant for each segment of MediumWalk
    /// plain delta tracking [WMHL65], which the others are measured against: one majorant for the whole
    /// medium, also for shadow rays; absorption ends paths by chance
    Analog
};

/// How the transmittance towards lights is found.
enum class ShadowEstimator : uint8_t
{
    Exact, ///< the medium's own integral if available, otherwise ratio tracking
    Ratio, ///< product of the shares of null collisions [NSJ14]
    Delta  ///< 1 when a free path passes the light, otherwise 0
};

/// A free path to be drawn.
struct FlightStart
{
    TraceRay ray;
    double begin = 0.0;                                   ///< [m] ray parameter
    double end = std::numeric_limits<double>::infinity(); ///< [m]
    bool isForced = false;                                ///< collides for certain; only by depth

    /// [1/sr] with which the direction was drawn at a place where light was also looked for in directions of
    /// PathMedium::emissionDirection(); 0: it was not
    double density = 0.0;
    /// places on the way where emitted light is looked up by each of two methods; 0: one place by one method
    uint32_t seenEmission = 0;
};

/// Where a free path ends.
struct Flight
{
    bool isScattered = false;
    double distance = 0.0; ///< [m] ray parameter of the scattering
    PhaseFunction phase;
    double colliding = 1.0; ///< [1] share of light that collides, if the collision was forced ...
    double passing = 0.0;   ///< [1] ... and that escapes
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
/// @deviation absorption is a weight in both branches of (3) instead of a third branch;
/// FlightEstimator::Analog
///   has the third branch
/// @valid     any number of segments; m > 0
/// @accuracy  unbiased; weights never grow above the largest b_c
/// @tests     tests/rendering/reference/path/test_path_flight.cpp

/// @formula free-path-by-depth
/// A free path, and the light emitted on the way, where the optical depth is known and has an inverse.
///
/// symbol   unit   meaning
///   T        1      optical depth of the way; D(t) from its beginning to t, x(t) [1/m] the extinction
///   C        1      1 for a free path that may escape, 1 - exp(-T) for one that collides for certain
///   e(t)     cd/m3  emitted light, its sum over channels s(t); E its integral over the way
///   n, m     1      places drawn by each of two methods
/// @derivation
///   depth of the collision: D = -ln(1 - u C); no collision when that exceeds T                     (1)
///   light exp(-T) passes, a collision carries C                                                    (2)
///   places where emitted light is looked up: by (1) with C = 1 - exp(-T), which has the density
///       p = x(t) exp(-D(t)) / (1 - exp(-T)), and in proportion to what is emitted, q = s(t) / E      (3)
///   light of a place of either method: exp(-D(t)) e(t) / (n p + m q)                               (4)
///   light of a medium that hardly emits: C e(t) / x(t) at the collision                            (5)
/// @source    elementary (inversion of the distribution function); [VG95] for the weights in (4)
/// @deviation none
/// @valid     T > 0; extinction that is the same for all channels
/// @accuracy  unbiased; the depth's inverse is that of DepthWalk
/// @tests     tests/rendering/reference/path/test_path_depth.cpp
///
/// One for each thread.
class MediumTracker
{
public:
    /// @param medium may be null; it must outlive this
    MediumTracker(const PathMedium* medium, FlightEstimator flight, ShadowEstimator shadow);

    /// One free path.
    /// @param io throughput, multiplied by the transmittance and the scattering weight
    /// @param outLuminance [cd/m2] light that the medium emitted on the way is added
    Flight fly(const FlightStart& start, PathSampler& sampler, glm::dvec3& io, glm::dvec3& outLuminance);

    /// Transmittance of the medium between two parameters, or an estimate without bias.
    glm::dvec3 transmittance(const TraceRay& ray, double begin, double end, PathSampler& sampler);

    /// The last way of fly(); null where flights are not by depth.
    const DepthWalk* lastWay() const { return depthWalk_.get(); }

    /// Emitted light that arrives from a direction of PathMedium::emissionDirection() [cd/m2]; not null only
    /// where flights are by depth.
    /// @param density [1/sr] with which the other method draws this direction: that of FlightStart
    /// @return light over the sum of both densities
    glm::dvec3 emissionFrom(const TraceRay& ray, double end, double density, PathSampler& sampler);

    uint64_t collisions() const { return collisions_; } ///< tentative collisions so far, as a measure of work

private:
    Flight flyByDepth(const FlightStart& start, PathSampler& sampler, glm::dvec3& io,
                      glm::dvec3& outLuminance);
    Flight flyByCollisions(const FlightStart& start, PathSampler& sampler, glm::dvec3& io,
                           glm::dvec3& outLuminance);

    ShadowEstimator shadow_;
    std::unique_ptr<MediumWalk> walk_, shadowWalk_;
    std::unique_ptr<DepthWalk> depthWalk_, emissionWalk_; ///< null: flights by collisions
    double majorant_ = 0.0;                               ///< [1/m] for everything; 0: local ones
    uint64_t collisions_ = 0;
};

} // namespace fx::render
