/// @file radial_flow.h
/// @formula radial-flow Gas dynamics in one dimension, planar or spherical, on cells that move with the gas:
/// the reference for cases without an exact solution. The reference is independent of the particle code: it
/// uses another method and another discretization.
///
/// symbol     unit        meaning
///   m_i       kg/sr       mass of cell i (planar: kg/m2), constant
///   r_f, A_f  m, m2/sr    radius and area of face f: A = r^2, planar 1
///   u, E      m/s, J/kg   velocity and specific total energy of a cell
///   p*, u*    Pa, m/s     state at a face
///   rho, c    kg/m3, m/s  density and speed of sound on one side of a face
///   d         m/s         u - u* on the left side, u* - u on the right side
/// @derivation
///   The mass of a cell is constant. Faces, momentum and energy change by
///       dr_f/dt = u*_f                                                                          (1)
///       m_i du_i/dt = -(A_i + A_{i+1}) / 2 (p*_{i+1} - p*_i)                                     (2)
///       m_i dE_i/dt = -(A_{i+1} p*_{i+1} u*_{i+1} - A_i p*_i u*_i)                               (3)
///   so energy is conserved to rounding. The states at a face come from limited linear profiles in the two
///   cells. A side that is compressed has the pressure behind a shock,
///       p* = p + rho d ((gamma + 1) / 4 d + sqrt(((gamma + 1) / 4 d)^2 + c^2))                   (4)
///   The same expression is used for d < 0, where it equals the rarefaction to second order in d. Newton's
///   method finds u* at which both sides give the same p*. Time integration: Heun's method with two stages.
/// @source    [DUK85] Dukowicz, doi:10.1016/0021-9991(85)90064-6, for a face from two shocks; the rest
/// textbook
/// @deviation Dukowicz replaces the square root in (4) by a straight line
/// @valid     ideal gas; cells never overtake each other while the step limits the change of their width
/// @accuracy  second order in smooth flow, first at shocks; energy and mass to rounding
/// @tests     tests/simulation/verification/test_radial_flow.cpp
#pragma once

#include "simulation/verification/flow_state.h"

#include <functional>
#include <vector>

namespace fx::sim {

struct RadialFlowDef
{
    double gamma = 1.4;
    bool spherical = true;
    int cells = 1000;           ///< number of cells, initially of equal width
    double length = 1;          ///< [m] length of the domain from the center or the wall at 0
    bool outerWall = true;      ///< true: a wall at the outer end; false: a free surface
    double outsidePressure = 0; ///< [Pa] pressure on the free surface
    std::function<FlowState(double radius)> initial;
};

class RadialFlow
{
public:
    explicit RadialFlow(const RadialFlowDef& def);

    /// Advances the flow to `time` [s].
    void advanceTo(double time);
    double time() const { return time_; }
    /// State at a radius; zero outside of the gas.
    FlowState at(double radius) const;
    double radius() const { return faces_.back(); } ///< [m] position of the outermost face
    double energy() const;        ///< [J] energy of the whole sphere, or of 1 m2 in planar flow
    double thermalEnergy() const; ///< [J] energy without kinetic energy

private:
    struct Cell
    {
        double velocity;
        double energy; ///< [J/kg] total energy
    };
    struct Face
    {
        double pressure;
        double velocity;
    };
    struct Rates
    {
        std::vector<double> faces;
        std::vector<Cell> cells;
    };
    double area(double radius) const { return def_.spherical ? radius * radius : 1.0; }
    double volume(size_t cell) const;
    double total(double kineticShare) const;
    void updateStates();
    void updateSlopes();
    FlowState sideOf(size_t cell, double radius) const;
    Face solveFace(const FlowState& left, const FlowState& right) const;
    Face solveWall(const FlowState& side, double sign) const;
    void computeRates(Rates& out);
    double stepLimit() const;

    RadialFlowDef def_;
    double time_ = 0;
    std::vector<double> masses_;
    std::vector<double> faces_;
    std::vector<Cell> cells_;
    /// Positions of cell centers. `centers_`, `states_` and `slopes_` are derived from `faces_` and `cells_`.
    std::vector<double> centers_;
    std::vector<FlowState> states_;
    std::vector<FlowState> slopes_; ///< derivatives per meter
};

} // namespace fx::sim
