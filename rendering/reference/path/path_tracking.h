/// @file path_tracking.h
/// Samples free paths through a medium. Also computes transmittances and the light that the medium emits
/// along a path.
#pragma once

#include "rendering/reference/path/path_medium.h"
#include "rendering/reference/path/path_sampler.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <limits>
#include <memory>

namespace fx::render {

/// Method by which free paths are sampled.
enum class FlightEstimator : uint8_t
{
    Depth, ///< inverts the optical depth if it has a closed form, else uses local majorants

    LocalMajorants, ///< samples null collisions, with a majorant for each segment of MediumWalk

    /// Plain delta tracking [WMHL65], which serves for comparison. One majorant is used for the whole medium,
    /// also for shadow rays. Absorption ends paths at random.
    Analog
};

/// Method by which the transmittance towards lights is computed.
enum class ShadowEstimator : uint8_t
{
    Exact, ///< uses the closed form of the medium if there is one, else ratio tracking
    Ratio, ///< uses ratio tracking: the product of the probabilities of null collisions [NSJ14]
    Delta  ///< uses 1 if a sampled free path is longer than the distance to the light, else 0
};

/// Input of a free path.
struct FlightStart
{
    TraceRay ray;
    double begin = 0.0;                                   ///< [m] ray parameter
    double end = std::numeric_limits<double>::infinity(); ///< [m]
    /// true: a collision is forced; requires FlightEstimator::Depth
    bool isForced = false;

    /// [1/sr] Probability density of the direction, if light at the beginning of the path was also sampled
    /// with PathMedium::emissionDirection(); else 0.
    double density = 0.0;
    /// Number of points on the path at which each of two methods samples the emission; 0: only one method
    /// samples, at one point.
    uint32_t seenEmission = 0;
};

/// Result of a free path.
struct Flight
{
    bool isScattered = false;
    double distance = 0.0; ///< [m] ray parameter at which the light is scattered
    PhaseFunction phase;
    double colliding = 1.0; ///< [1] fraction of light that collides, if the collision was forced
    double passing = 0.0;   ///< [1] fraction of light that escapes, if the collision was forced
};

/// @formula spectral-tracking
/// Unbiased sampling of a free path through a medium whose extinction differs between color channels.
///
/// symbol   unit   meaning
///   m        1/m    majorant of a segment, at least the extinction t_c of every channel c
///   s_c      1/m    scattering; n_c = m - t_c coefficient of null collisions
///   b_c      1      throughput of the path so far
///   P        1      probability that a tentative collision scatters
/// @derivation
///   distance to the next tentative collision: -ln(1 - u) / m. If the segment ends before it, sampling
///   starts again in the next segment, because the exponential distribution has no memory           (1)
///   P = S / (S + N), S = sum of b_c s_c, N = sum of b_c n_c                                        (2)
///   scattering: b_c <- b_c (s_c / m) / P;  null collision: b_c <- b_c (n_c / m) / (1 - P)          (3)
///   emitted light along the path: b_c e_c / m at every tentative collision                         (4)
/// @source    [KHLN17] Kutz et al., "Spectral and decomposition tracking for rendering heterogeneous
///            volumes", doi:10.1145/3072959.3073665, for (1) to (3); (4) is its collision estimator
/// @deviation absorption is a weight in both branches of (3) instead of a third branch, which only
///            FlightEstimator::Analog has
/// @valid     any number of segments; m > 0
/// @accuracy  unbiased; weights never exceed the largest initial b_c
/// @tests     tests/rendering/reference/path/test_path_flight.cpp

/// @formula free-path-by-depth
/// Sampling of a free path, and of the light emitted along it, by inverting the optical depth.
///
/// symbol   unit   meaning
///   T        1      optical depth of the whole path; D(t) from its beginning to t; x(t) [1/m] extinction
///   C        1      1 if the path may escape, 1 - exp(-T) if a collision is forced
///   e(t)     cd/m3  emission; s(t) its sum over channels; E integral of s over the path
///   n, m     1      number of points sampled by each of two methods
/// @derivation
///   depth of the collision: D = -ln(1 - u C); no collision if this exceeds T                       (1)
///   the share exp(-T) of light escapes; a collision has the weight C                               (2)
///   points for emission are sampled by (1) with C = 1 - exp(-T), that is with the density
///       p = x(t) exp(-D(t)) / (1 - exp(-T)), and in proportion to emission, q = s(t) / E            (3)
///   a point of either method contributes exp(-D(t)) e(t) / (n p + m q)                             (4)
///   if the medium emits little, the light is C e(t) / x(t) at the collision instead                (5)
/// @source    elementary (inversion of the distribution function); [VG95] for the weights in (4)
/// @deviation none
/// @valid     T > 0; the same extinction for all channels
/// @accuracy  unbiased; the inverse has the accuracy of DepthWalk
/// @tests     tests/rendering/reference/path/test_path_depth.cpp
///
/// Each thread needs its own object.
class MediumTracker
{
public:
    /// @param medium medium, which must outlive the tracker; null: empty space
    MediumTracker(const PathMedium* medium, FlightEstimator flight, ShadowEstimator shadow);

    /// Samples one free path.
    /// @param io throughput; it is multiplied by the transmittance and the scattering weight
    /// @param outLuminance [cd/m2] sum of light, to which the emission of the medium along the path is added
    Flight fly(const FlightStart& start, PathSampler& sampler, glm::dvec3& io, glm::dvec3& outLuminance);

    /// Transmittance of the medium between two ray parameters, exact or as an unbiased estimate.
    glm::dvec3 transmittance(const TraceRay& ray, double begin, double end, PathSampler& sampler);

    /// The ray of the last fly(), with its optical depth; null without FlightEstimator::Depth.
    const DepthWalk* lastWay() const { return depthWalk_.get(); }

    /// [cd/m2] Emitted light from a direction of PathMedium::emissionDirection(), divided by the sum of the
    /// densities of both methods that sample this direction. 0 without FlightEstimator::Depth.
    /// @param density [1/sr] probability density with which the phase function samples this direction, see
    ///         FlightStart::density
    glm::dvec3 emissionFrom(const TraceRay& ray, double end, double density, PathSampler& sampler);

    /// Number of tentative collisions so far, as a measure of work.
    uint64_t collisions() const { return collisions_; }

private:
    Flight flyByDepth(const FlightStart& start, PathSampler& sampler, glm::dvec3& io,
                      glm::dvec3& outLuminance);
    Flight flyByCollisions(const FlightStart& start, PathSampler& sampler, glm::dvec3& io,
                           glm::dvec3& outLuminance);

    ShadowEstimator shadow_;
    std::unique_ptr<MediumWalk> walk_, shadowWalk_;
    std::unique_ptr<DepthWalk> depthWalk_, emissionWalk_; ///< null if flights are sampled by collisions
    /// [1/m] majorant for the whole medium; 0: local majorants are used
    double majorant_ = 0.0;
    uint64_t collisions_ = 0;
};

} // namespace fx::render
