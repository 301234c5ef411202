/// @file gas_case.h
/// A flow with a known solution: initial particles, sampling times, and errors.
#pragma once

#include "simulation/sph/dynamics/gas_dynamics.h"
#include "simulation/verification/flow_state.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

namespace fx::sim {

constexpr double kNotMeasured = std::numeric_limits<double>::quiet_NaN();

/// Settings of a case.
struct CaseSettings
{
    /// Requested number of particles; 0: default of the case. The lattice rounds the number.
    uint32_t particles = 0;
    double gamma = 0; ///< [1] ratio of specific heats; 0: default of the case
    double time = 0;  ///< [s] end of the simulation; 0: default of the case
    /// Kernel, neighbors, viscosity, steps, courant and step ratio; the case sets all other members.
    GasDynamicsDef rules;
};

/// State of a particle at a sample.
struct CaseParticle
{
    glm::dvec3 position; ///< [m]
    glm::dvec3 velocity; ///< [m/s]
    double mass;         ///< [kg]
    double density;      ///< [kg/m3]
    double pressure;     ///< [Pa]
    double support;      ///< [m]
};

/// Position and state of a particle along the direction in which the flow varies.
struct ProfilePoint
{
    double place; ///< [m] distance from the center; in planar cases, the coordinate x
    double mass;  ///< [kg]
    FlowState state;
};

/// An additional result of a case.
struct Measure
{
    std::string name;
    double value = 0;
    std::string meaning;            ///< description with unit, for messages
    double expected = kNotMeasured; ///< exact or published value
};

/// A bound on a measure. The bound applies to the default settings of the case.
struct CaseLimit
{
    std::string name; ///< name of the measure
    double value = 0;
    double low = -std::numeric_limits<double>::infinity();
    double high = std::numeric_limits<double>::infinity();
    bool holds() const { return value >= low && value <= high; }
};

/// Error of the density of one particle.
struct DensityError
{
    double volume; ///< [m3] volume that the particle represents
    double error;  ///< signed error, in the case's unit of density
};

struct CaseMeasures
{
    double l1Density = kNotMeasured; ///< volume-weighted mean of |rho - exact|, in the case's unit of density
    double l1Velocity = kNotMeasured;
    double l1Pressure = kNotMeasured;
    double shockRadius = kNotMeasured; ///< [m]
    double shockRadiusExact = kNotMeasured;
    std::vector<DensityError> densityErrors; ///< errors of the particles over which l1Density averages
    std::vector<Measure> more;
    std::vector<CaseLimit> limits; ///< limits that apply to this number of particles and end time
};

class GasCase
{
public:
    virtual ~GasCase() = default;

    /// Definition of the dynamics of the case; its capacity is the number of particles.
    virtual const GasDynamicsDef& dynamics() const = 0;
    virtual const std::vector<GasParticle>& particles() const = 0;
    /// [s] Times of samples, ascending; the last time is the end of the simulation.
    virtual const std::vector<double>& sampleTimes() const = 0;
    /// Measures the particles at one of sampleTimes().
    virtual void look(double /*time*/, std::span<const CaseParticle> /*particles*/) {}
    virtual ProfilePoint seen(const CaseParticle& particle) const = 0;
    /// Computes the results of the case.
    /// @param particles state at the end
    virtual CaseMeasures measure(std::span<const CaseParticle> particles) const = 0;
    /// [1] Relative change of energy that is accepted with the default settings.
    virtual double energyTolerance() const { return 5e-3; }
};

} // namespace fx::sim
