/// @file particle_network.h
/// Multiple scattering in a medium at rest, computed by an illumination network whose nodes are the
/// particles.
///
/// The links of the network are computed once, for a medium that does not move. Light and albedo of a
/// network of cells (ScatteringNetwork) may change with the medium in each frame; use that network unless
/// the medium is small and at rest.
///
/// Threads: one at a time. Loops run in the given task runner. The result is bit-identical for any number of
/// workers.
#pragma once

#include "rendering/network/particle_links.h"
#include "rendering/network/scattering_network.h"

namespace fx::render {

/// Number of links and phase function of a particle network.
struct ParticleNetworkSettings
{
    int directions = 64; ///< even number, 6..512; a forward phase function needs many, see particle-network
    int lines = 48;      ///< number of lines of a bundle along each axis of its square, 4..512
    /// [1] Length of the segments of a line, in mean radii of the particles, 0.1..10. 0: each particle is met
    /// as a whole, one after another, which is faster, and wrong where particles overlap.
    double segment = 0.5;
    double anisotropy = 0.0; ///< [1] mean cosine g of the phase function, -0.9..0.9
};

/// @formula particle-network
/// Light that particles scatter to each other along bundles of parallel lines.
///
/// symbol      unit     meaning
///   D, d      1        number of directions; a direction
///   w         sr       weight of a direction, 4 pi / D
///   F_d       m2 cd/m2 light that a particle meets in the direction d, see particle-bundle
///   sigma     m2       extinction cross section of the particle
///   s_d       cd/m2    source function of the particle
///   E, Q_d    cd/m2    emission per optical depth; scattered light of sources outside of the network
///   p         1/sr     function of Henyey and Greenstein of the angle between two directions
///   x_d       1        factor of a direction
///   q         1        largest albedo, at most 1 - 2^-20
/// @derivation
///   Directions are those of a Fibonacci lattice on a hemisphere and the opposite ones, so that opposite
///   directions share their lines. Sums over D of p are not 1 for forward phase functions: scattering would
///   make light. With P_dd' = w x_d x_d' p, the x_d are chosen so that
///       sum over d of P_dd' = sum over d' of P_dd' = 1                                          (1)
///   by steps x_d <- (x_d / sum over d' of w x_d' p)^(1/2), until (1) holds within 1e-9. Then
///       s_d = albedo / sigma sum over d' of P_dd' F_d' + Q_d + E                                (2)
///   Each iteration follows all bundles, then applies (2). Light that is scattered either meets particles
///   again or escapes, so in the norm sum of w sigma |value| an iteration reduces differences by q     (3)
///   and the error after an iteration that changed the light by c is at most c q / (1 - q). 2^-22 is added
///   to c for rounding                                                                           (4)
///   Light that reaches an eye has one more row of (1) for the direction to the eye, whose sum is 1 (5)
/// @source    [SSU05] the network; [SK67] (1); [GON10] the lattice
/// @deviation (1) by square roots, so that P stays symmetric; acceleration as network-sweep
/// @valid     media at rest; -0.9 <= g <= 0.9
/// @accuracy  relative error of the radiance in a furnace 1e-5, of the energy balance 1e-5; the same bits for
///            any number of workers
/// @tests     tests/rendering/network/test_particle_network.cpp
class ParticleNetwork
{
public:
    static constexpr size_t kMaxParticles = 4096;
    static constexpr double kMaxBytes = 0x1p31; ///< [byte] largest value of mostBytes()

    /// [byte] Estimate of the memory in which a network is built and iterated, from an upper bound of its
    /// links; lists that grow may have as much in spare.
    static double mostBytes(std::span<const NetworkParticle> particles,
                            const ParticleNetworkSettings& settings);

    /// Computes the links of a medium at rest. Also sets all light to 0.
    /// @return InvalidArgument for values outside of their ranges; TooLarge for more than kMaxParticles
    ///     particles or kMaxBytes bytes. Then the network does not change
    base::Status build(std::span<const NetworkParticle> particles, const ParticleNetworkSettings& settings,
                       base::TaskRunner& tasks);

    /// Sets the light that enters from outside. The light of the last iteration stays.
    /// @param radiance [cd/m2] for each element of directions(), radiance of the light that travels in this
    ///     direction
    /// @return InvalidArgument for a wrong number of values, or for values that are negative or not finite
    base::Status setEnvironment(std::span<const float> radiance);
    /// Removes the light that addDirect() has added.
    void clearDirect();
    /// Adds light of a source outside of the network, which a particle scatters for the first time.
    /// @param travel unit vector along which the light travels
    /// @param irradiance [lx] mean in the particle, weighted by its extinction, perpendicular to the light
    void addDirect(size_t particle, const glm::dvec3& travel, double irradiance);

    /// Runs iterations from the light of the last one. See SweepRules; `sweeps` is the number of iterations.
    SweepReport iterate(const SweepRules& rules, base::TaskRunner& tasks);
    /// Computes the energy of the light after one more iteration, which is not stored.
    NetworkEnergy energy(base::TaskRunner& tasks) const;

    /// [cd/m2] Light per optical depth that a particle has met in the network and scatters in a direction:
    /// (5).
    double scattered(size_t particle, const glm::dvec3& direction) const;
    /// [cd/m2] Mean over all directions of the radiance that a particle meets in the network.
    double meanRadiance(size_t particle) const;

    const std::vector<glm::dvec3>& directions() const { return directions_; } ///< unit vectors
    size_t links() const;
    size_t bytes() const; ///< [byte] of all links

private:
    size_t count() const { return particles_.size(); }
    double weight() const; ///< [sr] symbol w
    void normalizePhase();
    /// Symbols F of the source functions of `light`, for each direction and particle.
    void follow(const std::vector<float>& light, std::vector<double>& outMet,
                std::vector<ParticleBundle::Ends>& outEnds, base::TaskRunner& tasks) const;
    void scatter(const std::vector<double>& met, std::vector<float>& outLight, base::TaskRunner& tasks) const;
    void storeChange(const std::vector<float>& before, const std::vector<float>& after);

    std::vector<NetworkParticle> particles_;
    double anisotropy_ = 0.0;
    std::vector<glm::dvec3> directions_;  ///< each axis, then its opposite
    std::vector<ParticleBundle> bundles_; ///< one for two directions
    std::vector<double> factors_;         ///< [1] symbols x_d
    std::vector<float> phase_;            ///< [1] symbols P_dd', d after d'
    std::vector<float> crossSections_;    ///< [m2]
    std::vector<float> environment_;      ///< [cd/m2] by direction
    std::vector<float> direct_;           ///< [cd/m2] symbols Q_d: for each direction, all particles
    std::vector<float> light_;            ///< [cd/m2] first part of (2); likewise
    std::vector<double> met_;             ///< [m2 cd/m2] symbols F of the last iteration; likewise
    bool isNew_ = true;                   ///< true: light has changed since the last iteration
    NetworkMixing mixing_;
    SweepReport last_;
};

} // namespace fx::render
