/// @file particle_links.h
/// Links between the particles of a medium: parallel lines through the particles, and the optical depth of
/// each particle on each line.
#pragma once

#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace fx::render {

/// A ball of medium with the quartic kernel.
struct NetworkParticle
{
    glm::dvec3 center{0.0};    ///< [m]
    double radius = 0.0;       ///< [m] > 0
    double crossSection = 0.0; ///< [m2] integral of the extinction over space, > 0
    double albedo = 0.0;       ///< [1] 0..1
    /// [cd/m2] Emission per optical depth, >= 0, as NetworkMedium::emission.
    double emission = 0.0;
};

/// @formula particle-bundle
/// Radiance along parallel lines through balls, and the light that each ball meets.
///
/// symbol    unit     meaning
///   A       m2       cross section of a line
///   sigma   m2       extinction cross section of a ball
///   t       1        optical depth of a ball in a segment of a line
///   tau     1        optical depth of all balls in a segment
///   s, S    cd/m2    source function of a ball in the line's direction; mean of the segment's balls
///   I, I'   cd/m2    radiance at entry and exit of a segment
///   a       1        share of the radiance that a segment replaces: (1) and (2) of network-cell for tau
///   F       m2 cd/m2 light that a ball meets: radiance integrated over its extinction
/// @derivation
///   The depth of a ball on a line is that of kernel-optical-depth. A bundle samples each ball with few
///   lines, so the depths of a ball on all lines of a bundle are scaled by one factor for which
///       A sum of t = sigma                                                                      (1)
///   A ball between the lines counts on the nearest line. A segment may hold several balls:
///       S = sum of t s / tau, I' = I + a (S - I)                                                (2)
///   What a line gains is what its balls emit less what they meet, and each ball meets its share:
///       F = A sum over segments of t / tau (tau S - I' + I)                                     (3)
///   So (1) to (3) neither make nor lose light. With I = s = 1 everywhere, F is sigma.
///   Segments of equal length let balls that overlap share each other's light, and a ball its own. If each
///   ball has one segment, at the middle of its chord, balls see each other one after another (4)
/// @source    [SSU05] for bundles of lines and (4); the rest is elementary
/// @deviation the paper links a particle to the one that it sees; here the light of a line passes through all
///            of its particles
/// @valid     any tau >= 0
/// @accuracy  (1) within 1e-6
/// @tests     tests/rendering/network/test_particle_network.cpp
///
/// Immutable after construction. Threads: any.
class ParticleBundle
{
public:
    /// Geometry that all bundles of a network share.
    struct Space
    {
        glm::dvec3 center{0.0};
        double half = 1.0;    ///< [m] radius of a ball around `center` that contains all particles
        int lines = 1;        ///< number of lines along each axis of the bundle's square
        double segment = 0.0; ///< [m] length of a segment; 0: each particle has one, see (4)

        double area() const { return 4.0 * half * half / double(lines) / double(lines); } ///< [m2]
    };

    ParticleBundle() = default;
    /// @param axis unit vector along which the lines run
    ParticleBundle(std::span<const NetworkParticle> particles, const glm::dvec3& axis, const Space& space);

    /// Light through all lines.
    struct Ends
    {
        double entering = 0.0, leaving = 0.0; ///< [m2 cd/m2]
    };
    /// Follows the light along all lines.
    /// @param forward true: along the axis, false: against it
    /// @param source [cd/m2] for each particle, symbol s
    /// @param entering [cd/m2] radiance of light from outside
    /// @param ioMet [m2 cd/m2] for each particle; symbol F is added
    Ends follow(bool forward, std::span<const float> source, double entering, std::span<double> ioMet) const;

    size_t links() const { return links_.size(); } ///< number of symbols t
    /// [byte] Memory for a link while its bundle is built, without the spare capacity of lists.
    static constexpr size_t kBytesOfLink = 68;
    size_t bytes() const;

private:
    struct Link
    {
        uint32_t particle;
        float depth; ///< [1] symbol t
    };
    struct Segment
    {
        double depth, taken; ///< [1] symbols tau and a
        uint32_t end;        ///< index after the last link
    };
    /// Radiance at the exit of a segment.
    double throughSegment(size_t segment, double radiance, std::span<const float> source,
                          std::span<double> ioMet) const;

    double area_ = 0.0;
    std::vector<uint32_t> lineEnds_; ///< for each line with particles, index after its last segment
    std::vector<Segment> segments_;
    std::vector<Link> links_;
};

} // namespace fx::render
