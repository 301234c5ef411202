/// @file flow_errors.h
/// Errors of particles against a known flow.
///
/// @formula flow-error
/// Mean distance between particles and the exact flow, each counted by the volume it stands for; the place of
/// a shock in the profile.
///
/// symbol    unit    meaning
///   m, rho   kg, kg/m3  mass and density of a particle
///   q, q_e   any     density, velocity or pressure, and its exact value at the particle
///   s        m       width of a shell
///   D_k      kg/m3   mean density of the particles in shell k
/// @derivation
///   L1(q) = sum (m / rho) |q - q_e| / sum (m / rho)                                             (1)
///   The shock is where, coming from outside, D passes half the way from the density ahead to the largest D:
///       D = (rho_ahead + max D) / 2, linear between the centers of shells                        (2)
///   Where the density falls off on both sides of the shock, as behind a point blast, the particles smear it
///   evenly and the shock is at the top of the parabola through the largest D and its neighbors         (3)
/// @source    own definition; [PRI12] Price, section 4, uses (1) on particles of equal volume
/// @deviation none
/// @valid     at least one particle; in (2) rho_ahead below max D
/// @accuracy  (2): a shock smeared evenly over both sides keeps its place to a quarter of the smearing
/// @tests     tests/simulation/verification/test_flow_errors.cpp
#pragma once

#include "simulation/verification/gas_case.h"

#include <functional>
#include <span>
#include <vector>

namespace fx::sim {

/// Sums (1).
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

/// A shell of the profile.
struct Shell
{
    double place = 0;   ///< [m] its middle
    uint32_t count = 0; ///< particles; the state is 0 without particles
    FlowState state;    ///< means over particles
};

std::vector<Shell> shellsOf(std::span<const ProfilePoint> points, double width);

/// (2). Zero when no shell is denser than the gas ahead.
double shockRadius(std::span<const Shell> shells, double densityAhead);

/// (3).
double densestRadius(std::span<const Shell> shells);

std::vector<ProfilePoint> profileOf(const GasCase& gasCase, std::span<const CaseParticle> particles);

/// Errors against `exact` of all points nearer than `radius`.
void storeErrors(std::span<const ProfilePoint> points, double radius, const FlowState& units,
                 const std::function<FlowState(double place)>& exact, CaseMeasures& out);

} // namespace fx::sim
