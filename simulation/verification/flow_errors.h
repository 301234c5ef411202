/// @file flow_errors.h
/// Errors of simulated particles against an exact flow.
///
/// @formula flow-error
/// Mean deviation of particles from the exact flow, weighted by their volume, and the position of a shock in
/// the profile.
///
/// symbol    unit    meaning
///   m, rho   kg, kg/m3  mass and density of a particle
///   q, q_e   any     density, velocity or pressure, and its exact value at the particle
///   s        m       width of a shell
///   D_k      kg/m3   mean density of the particles in shell k
/// @derivation
///   L1(q) = sum (m / rho) |q - q_e| / sum (m / rho)                                             (1)
///   The shock is at the outermost radius where D equals the mean of the density ahead and the largest D:
///       D = (rho_ahead + max D) / 2, linear between the centers of shells                        (2)
///   Where the density falls on both sides of the shock, as behind a point blast, the particles smear the
///   shock evenly. Then the shock is at the top of the parabola through the largest D and its neighbors
///   (3)
/// @source    own definition; [PRI12] Price, section 4, uses (1) on particles of equal volume
/// @deviation none
/// @valid     at least one particle; in (2) rho_ahead below max D
/// @accuracy  (2): smearing a shock evenly to both sides moves it by at most a quarter of the smearing width
/// @tests     tests/simulation/verification/test_flow_errors.cpp
#pragma once

#include "simulation/verification/gas_case.h"

#include <functional>
#include <span>
#include <vector>

namespace fx::sim {

/// Accumulates the sums of equation (1) over particles.
class FlowErrors
{
public:
    void add(const ProfilePoint& point, const FlowState& exact);
    /// Writes l1Density, l1Velocity, l1Pressure and densityErrors in the given units.
    void store(const FlowState& units, CaseMeasures& out) const;

private:
    double volume_ = 0;
    FlowState sum_;
    std::vector<DensityError> densities_;
};

/// Means over the particles in one shell of the profile. A shell is an interval of the distance from the
/// origin.
struct Shell
{
    double place = 0;   ///< [m] middle of the interval
    uint32_t count = 0; ///< number of particles; if it is 0, `state` is 0
    FlowState state;    ///< means over particles
};

std::vector<Shell> shellsOf(std::span<const ProfilePoint> points, double width);

/// Radius of the shock by equation (2); 0 if no shell is denser than the gas ahead of the shock.
double shockRadius(std::span<const Shell> shells, double densityAhead);

/// Radius of the shock by equation (3).
double densestRadius(std::span<const Shell> shells);

std::vector<ProfilePoint> profileOf(const GasCase& gasCase, std::span<const CaseParticle> particles);

/// Computes the errors against `exact` of all points nearer than `radius`, and stores them in `out`.
void storeErrors(std::span<const ProfilePoint> points, double radius, const FlowState& units,
                 const std::function<FlowState(double place)>& exact, CaseMeasures& out);

} // namespace fx::sim
