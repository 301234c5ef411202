/// @file scattering_network.h
/// Multiple scattering in a medium, computed by an illumination network: cells of a grid exchange light with
/// their neighbors.
///
/// The network has one color channel. A frame sets the medium and the unscattered light in it, then runs a
/// few sweeps (iterations). A sweep propagates the light of the previous sweep along all lines of cells.
/// There is no precomputation, so media may move.
///
/// Threads: one at a time. Loops run in the given task runner. The result is bit-identical for any number of
/// workers.
#pragma once

#include "foundation/result/status.h"
#include "foundation/tasks/task_runner.h"
#include "rendering/network/network_basis.h"
#include "rendering/network/network_mixing.h"
#include "rendering/network/network_phase.h"
#include "rendering/network/network_state.h"

#include <array>
#include <span>
#include <vector>

namespace fx::render {

/// Directions, moments and phase function of a network.
struct NetworkSettings
{
    int directions = 26;     ///< number of directions: 6, 14 or 26; 6 directions require 4 moments
    int moments = 4;         ///< number of moments, 4 or 9; 9 moments are for a mean cosine g above 0.4
    double anisotropy = 0.0; ///< [1] mean cosine g of the phase function, -1..1, see formula network-phase
};

/// The medium in the cells. Arrays have one value per cell.
struct NetworkMedium
{
    NetworkGrid grid;                  ///< grid of 1 to 256 cells along each axis
    std::span<const float> extinction; ///< [1/m] >= 0
    std::span<const float> albedo;     ///< [1] 0..1
    /// [cd/m2] Emission per optical depth, >= 0. For a gray body, the emission is (1 - albedo) times the
    /// black-body luminance. Empty: no emission.
    std::span<const float> emission;
};

/// Conditions for the end of sweeps, and acceleration of convergence.
struct SweepRules
{
    int sweeps = 1; ///< largest number of sweeps
    /// Number of earlier sweeps that are mixed, 0..4; speeds up convergence for albedos above 0.9.
    int acceleration = 2;
    double tolerance = 0.0; ///< [1] sweeps end when SweepReport::change is at most this tolerance
};

/// Result of the last sweeps. "Scattered light" is the power that the medium scatters, summed over all cells.
struct SweepReport
{
    /// Number of sweeps. 0: no sweep was needed, because medium and light have not changed and the tolerance
    /// is met.
    int sweeps = 0;
    /// [1] Change of the scattered light by the last sweep, divided by the scattered light.
    double change = 0.0;
    /// [1] Upper bound of the error of the scattered light, divided by the scattered light.
    double bound = 0.0;
    bool isConverged = true; ///< true: the change is within the tolerance
};

/// Powers, in units of radiance times [m2 sr]. After convergence, emitted = absorbed + escaped.
struct NetworkEnergy
{
    /// Emission of the medium, first scattering of light sources, and light from outside.
    double emitted = 0.0;
    double absorbed = 0.0; ///< absorbed power of emitted and scattered light
    double escaped = 0.0;
};

/// @formula network-sweep
/// Radiance along a line of cells, and its moments in each cell.
///
/// symbol        unit    meaning
///   k', albedo' 1/m, 1  extinction and albedo without the forward peak, see network-phase
///   l           m       length of a line in a cell
///   tau         1       k' l
///   S           cd/m2   source function of a cell in a direction
///   I, I', M    cd/m2   radiance at entry and exit of a cell; mean radiance in it
///   e, a, u     1       (1 - exp(-tau)) / tau; 1 - exp(-tau); 1 - e
///   J_k, Q_k    cd/m2 sr moments of M; moments of unscattered light
///   w, Y_k      sr, 1   weight and harmonics of a direction
///   E           cd/m2   emission per optical depth of the whole extinction k
///   q           1       largest share of scattered light that is scattered again
/// @derivation
///   S = albedo' sum of g_l (J_k + Q_k) Y_k + E / (1 - albedo f)                                  (1)
///   In a homogeneous cell, I' = I exp(-tau) + S (1 - exp(-tau)), and M is the mean of this along the line.
///   With D = S - I,
///       I' = I + a D, M = I + u D                                                               (2)
///       J_k = sum over directions of w Y_k M                                                    (3)
///   tau (S - M) = I' - I: the gain of a line is emission minus absorption in the cell, so that energy is
///   conserved. Lines in a direction of squared length s have the cross section side^2 / sqrt(s)  (4)
///   All factors and the phase function are >= 0, and so is M; negative rounding errors are set to 0.
///   Each sweep is an affine map of the scattered light. Light that a cell scatters either meets matter again
///   or escapes. So in the norm sum over cells of volume * k' * |value|, the map reduces differences by
///       q = largest albedo', at most 1 - 2^-20                                                  (5)
///   After a sweep that changed the light by c, its error is at most c q / (1 - q), where 2^-22 is
///   added to c for rounding                                                                    (6)
///   c is bounded by sqrt(4 pi sum over k of (change of moment k of S)^2)                        (7)
///   Acceleration replaces the light by a mix of earlier sweeps, see network-mixing. A cell in which S would
///   be negative keeps its light. The last step is always a sweep.
/// @source    [LEB76] directions; [WN11] the acceleration; (5) and (6) by Banach's fixed-point theorem; the
///            rest is elementary
/// @deviation cells are homogeneous, and their light is a mean, so that energy is conserved exactly; it would
///            not be if light were interpolated between nodes
/// @valid     any k >= 0; albedo 0..1
/// @accuracy  relative error of the radiance in a furnace 1e-5, of the energy balance 1e-5; the same bits for
///            any number of workers
/// @tests     tests/rendering/network/test_scattering_network.cpp
class ScatteringNetwork
{
public:
    /// Sets the medium. Also sets the unscattered light and the light from outside to 0.
    /// @return InvalidArgument for values outside of their ranges; then the network does not change
    base::Status setMedium(const NetworkMedium& medium, const NetworkSettings& settings);

    /// Sets the light that enters from outside.
    /// @param radiance [cd/m2] for each element of directions(), radiance of the light that travels in this
    ///     direction
    /// @return InvalidArgument for a wrong number of values, or for values that are negative or not finite
    base::Status setEnvironment(std::span<const float> radiance);

    /// Adds unscattered light in a cell.
    /// @param moments [lx] mean irradiance in the cell, perpendicular to the light, times harmonics() of the
    ///         direction in which the light travels
    void addDirect(size_t cell, const std::array<double, kMaxNetworkMoments>& moments);

    /// Runs sweeps. The first sweep starts from the light of `io`, which may have another grid or be empty.
    /// `io` receives the result.
    SweepReport sweep(const SweepRules& rules, NetworkState& io, base::TaskRunner& tasks);

    /// Computes the energy of the light after one more sweep. The result of the sweep is not stored.
    NetworkEnergy energy(const NetworkState& state, base::TaskRunner& tasks);

    /// [1] Optical depth, without the forward peak, along a line through the grid. @param length [m] length
    /// of the line
    double opticalDepth(const glm::dvec3& from, const glm::dvec3& direction, double length) const;

    const NetworkGrid& grid() const { return grid_; }
    const NetworkPhase& phase() const { return phase_; }
    const std::vector<NeighborDirection>& directions() const { return directions_; }
    int moments() const { return moments_; }
    /// [1/m] Symbol k' of formula network-sweep in a cell.
    float extinction(size_t cell) const { return extinction_[cell]; }
    double contraction() const { return contraction_; } ///< [1] symbol q

private:
    /// Radiance that enters and leaves the grid in one direction [cd/m2]: sums over all lines of cells.
    struct Ends
    {
        double entering = 0.0, leaving = 0.0;
    };
    template <int Moments>
    void followLines(base::TaskRunner& tasks);
    template <int Moments>
    void followDirection(size_t d);
    template <int Moments>
    void followRow(size_t d, size_t first, const float* in, float* out);
    template <int Moments>
    void followAlongX(size_t d);
    void countEnds(size_t d, const glm::ivec3& row, const float* out);

    /// Runs one sweep from the moments `light`, and writes the result to next_.
    void sweepOnce(const std::vector<float>& light, base::TaskRunner& tasks);
    void findSources(const std::vector<float>& light, base::TaskRunner& tasks);
    void sumMoments(base::TaskRunner& tasks);
    void storeChange(const std::vector<float>& before, const std::vector<float>& after);
    void keepPositive(const std::vector<float>& swept, std::vector<float>& ioMixed) const;
    size_t count() const { return grid_.count(); }

    NetworkGrid grid_;
    NetworkPhase phase_;
    int moments_ = 4;
    double contraction_ = 0.0;
    bool isNew_ = true; ///< true: medium or light has changed since the last sweep
    std::vector<NeighborDirection> directions_;
    std::vector<std::array<float, kMaxNetworkMoments>> harmonics_; ///< by direction
    std::vector<float> extinction_;                                ///< [1/m] symbol k'
    std::vector<float> scattering_;                                ///< [1] symbol albedo'
    std::vector<float> emission_;    ///< [cd/m2] E / (1 - albedo f), see formula network-sweep
    std::vector<float> direct_;      ///< [lx] symbol Q_k
    std::vector<float> environment_; ///< [cd/m2] for each direction
    /// [1] Symbols a and u of formula network-sweep for steps of squared length 1, 2, 3.
    std::array<std::vector<float>, 3> taken_, mean_;
    std::vector<float> source_;   ///< [cd/m2] moments of S
    std::vector<float> radiance_; ///< [cd/m2] symbol M for each direction
    std::vector<float> next_;
    /// [cd/m2] For each direction: symbol I' of formula network-sweep in two slices of cells.
    std::vector<std::vector<float>> planes_;
    std::vector<Ends> ends_; ///< by direction
    NetworkMixing mixing_;
    SweepReport last_;
};

} // namespace fx::render
