/// @file scattering_network.h
/// Light that a medium scatters any number of times: cells of a grid exchange light with their neighbors.
///
/// One color channel. A frame sets the medium and the light that reaches it unscattered, then sweeps a few
/// times: each sweep takes the light of the last one along all lines of cells. Nothing is precomputed, so
/// that media may move.
///
/// Threads: one at a time; loops run in the given runner, with the same bits for any number of workers.
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

/// Form of a network.
struct NetworkSettings
{
    int directions = 26;     ///< 6, 14 or 26; 6 take 4 moments only
    int moments = 4;         ///< 4, or 9 for g above 0.4
    double anisotropy = 0.0; ///< [1] mean cosine g of the phase function, -1..1, see network-phase
};

/// What fills the cells, one value a cell.
struct NetworkMedium
{
    NetworkGrid grid;                  ///< 1 to 256 cells along each axis
    std::span<const float> extinction; ///< [1/m] >= 0
    std::span<const float> albedo;     ///< [1] 0..1
    /// [cd/m2] per optical depth, >= 0, as Kirchhoff's law has it: a cell that emits B like a black body has
    /// (1 - albedo) B; empty: none
    std::span<const float> emission;
};

/// What sweeps are to do.
struct SweepRules
{
    int sweeps = 1;         ///< at most
    int acceleration = 2;   ///< earlier sweeps that are mixed in, 0..4; 0: none. For albedos above 0.9
    double tolerance = 0.0; ///< [1] `change` from which on nothing is left to do
};

/// What the last sweeps did. Light is measured by the power that the medium scatters, summed over the cells.
struct SweepReport
{
    int sweeps = 0;          ///< that were made; 0: medium and light rest, and the tolerance is met
    double change = 0.0;     ///< [1] of the scattered light by the last sweep, as a share of it
    double bound = 0.0;      ///< [1] scattered light is off by no more than this share of it
    bool isConverged = true; ///< the change is within the tolerance
};

/// Powers, divided by the unit of radiance [m2 sr]. In light at rest emitted = absorbed + escaped.
struct NetworkEnergy
{
    /// by the medium, by what lights scatter there for the first time, and from outside
    double emitted = 0.0;
    double absorbed = 0.0; ///< of scattered and emitted light
    double escaped = 0.0;
};

/// @formula network-sweep
/// Radiance along a line of cells, and its moments in each of them.
///
/// symbol        unit    meaning
///   k', albedo' 1/m, 1  extinction and albedo without the forward peak, see network-phase
///   l           m       length of a line's way through a cell
///   tau         1       k' l
///   S           cd/m2   source function of a cell in a direction
///   I, I'       cd/m2   radiance before and behind the cell; M its mean within
///   e, a, u     1       (1 - exp(-tau)) / tau; 1 - exp(-tau); 1 - e
///   J_k         cd/m2 sr moments of M; Q_k those of light that is not scattered yet
///   w, Y_k      sr, 1   weight and harmonics of a direction
///   E           cd/m2   emission per optical depth of the whole extinction k
///   q           1       largest share of scattered light that is scattered again
/// @derivation
///   S = albedo' sum of g_l (J_k + Q_k) Y_k + E / (1 - albedo f)                                  (1)
///   In a cell that is even, I' = I exp(-tau) + S (1 - exp(-tau)), and M is the mean of that over the way.
///   With D = S - I,
///       I' = I + a D, M = I + u D                                                               (2)
///       J_k = sum over directions of w Y_k M                                                    (3)
///   tau (S - M) = I' - I: what a line gains is what the cell emits less what it takes, so that no light is
///   made or lost. A direction of squared length s has lines of cross section side^2 / sqrt(s)   (4)
///   All factors and the phase function are at least 0, and so is M; what rounding takes from that is
///   given back.
///   Each sweep is an affine map of the scattered light. All light that a cell scatters meets matter again
///   or escapes: in the sum over cells of volume, k' and absolute value the map shrinks differences by
///       q = largest albedo', at most 1 - 2^-20                                                  (5)
///   so that after a sweep which changed the light by c it is at most c q / (1 - q) off, where 2^-22 is
///   added to c for rounding                                                                    (6)
///   c is bounded by sqrt(4 pi sum over k of (change of moment k of S)^2)                        (7)
///   Acceleration mixes earlier sweeps so that the change of their mean is least. Where the mix has a
///   negative S, a cell keeps its light; the last step is always a sweep.
/// @source    [LEB76] directions; [WN11] the acceleration; (5) and (6) are Banach's fixed-point theorem; the
///            rest is elementary
/// @deviation cells are even, and their light is a mean: (4) holds exactly, where light that is interpolated
///            between nodes loses it
/// @valid     any k >= 0; albedo 0..1
/// @accuracy  furnace 1e-5; energy 1e-5; same bits for any number of workers
/// @tests     tests/rendering/network/test_scattering_network.cpp
class ScatteringNetwork
{
public:
    /// Takes over a medium. Unscattered light and environment are black afterwards.
    /// @return InvalidArgument for numbers outside their ranges; the network then keeps what it had
    base::Status setMedium(const NetworkMedium& medium, const NetworkSettings& settings);

    /// Light that comes from outside. @param radiance [cd/m2] for each of directions(), which are those in
    /// which light travels
    /// @return InvalidArgument for another count, or numbers that are negative or not finite
    base::Status setEnvironment(std::span<const float> radiance);

    /// Unscattered light in a cell. @param moments [lx] sums of irradiance across the way of the light, mean
    /// in the cell, times harmonics() of its direction of travel
    void addDirect(size_t cell, const std::array<double, kMaxNetworkMoments>& moments);

    /// Sweeps, beginning with the light of `io`, which may be of another grid or empty.
    SweepReport sweep(const SweepRules& rules, NetworkState& io, base::TaskRunner& tasks);

    /// Of the light after one more sweep, which is not stored.
    NetworkEnergy energy(const NetworkState& state, base::TaskRunner& tasks);

    /// [1] optical depth without the forward peak along a line through the grid.
    double opticalDepth(const glm::dvec3& from, const glm::dvec3& direction, double length) const;

    const NetworkGrid& grid() const { return grid_; }
    const NetworkPhase& phase() const { return phase_; }
    const std::vector<NeighborDirection>& directions() const { return directions_; }
    int moments() const { return moments_; }
    /// [1/m] k' of a cell.
    float extinction(size_t cell) const { return extinction_[cell]; }
    double contraction() const { return contraction_; } ///< [1] q

private:
    /// What followLines() counts, of each direction [cd/m2], summed over its lines.
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

    /// One sweep from `light` to next_.
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
    bool isNew_ = true; ///< medium or light changed since the last sweep
    std::vector<NeighborDirection> directions_;
    std::vector<std::array<float, kMaxNetworkMoments>> harmonics_; ///< of each direction
    std::vector<float> extinction_;                                ///< [1/m] k'
    std::vector<float> scattering_;                                ///< [1] albedo'
    std::vector<float> emission_;                                  ///< [cd/m2] E / (1 - albedo f)
    std::vector<float> direct_;                                    ///< [lx] Q_k
    std::vector<float> environment_;                               ///< [cd/m2] of each direction
    std::array<std::vector<float>, 3> taken_, mean_; ///< [1] a and u for squared lengths 1, 2, 3
    std::vector<float> source_;                      ///< [cd/m2] moments of S
    std::vector<float> radiance_;                    ///< [cd/m2] M of each direction
    std::vector<float> next_;
    std::vector<std::vector<float>> planes_; ///< [cd/m2] I' of two slices, of each direction
    std::vector<Ends> ends_;                 ///< of each direction
    NetworkMixing mixing_;
    SweepReport last_;
};

} // namespace fx::render
