/// @file air_blast.h
/// @formula air-blast
/// Measured free-air blast of TNT: peak overpressure, duration, history.
///
/// symbol    unit        meaning
///   Z        m/kg^(1/3)  scaled distance: distance over the cube root of the charge's mass
///   p0       Pa          pressure of the air, 101325
///   ps       Pa          peak overpressure of the incident wave
///   td       s           duration of the positive phase
///   b        1           decay of the wave
///   U, c_k   1           argument and coefficients of the polynomial
/// @derivation
///   Fit to measurements of chemical explosions in free air, with Z:
///       ps / p0 = 808 (1 + (Z/4.5)^2) / sqrt((1 + (Z/0.048)^2) (1 + (Z/0.32)^2) (1 + (Z/1.35)^2))      (1)
///   Fit to measurements of TNT spheres in free air:
///       log10(ps / kPa) = sum_k c_k U^k,  U = -0.214362789151 + 1.35034249993 log10 Z                   (2)
///   The overpressure at a place, at time t after the arrival of the wave:
///       p = ps (1 - t/td) exp(-b t/td)                                                                  (3)
/// @source    [KG85] Kinney, Graham, chapter 6, for (1); [KB84] Kingery, Bulmash, for (2), spherical charge,
///            incident pressure; (3) is the wave of Friedlander, as [KG85] gives it
/// @deviation the coefficients of (2) are those of published programs, since the report is a scan
/// @valid     (1) 0.05 to 500 m/kg^(1/3); (2) 0.0531 to 40 m/kg^(1/3); sea level, 15 degrees
/// @accuracy  (1) and (2) agree within 15 % for Z from 0.5 to 10
/// @tests     tests/simulation/verification/test_air_blast.cpp
#pragma once

#include <span>

namespace fx::sim {

constexpr double kAirPressure = 101325;  ///< [Pa]
constexpr double kAirDensity = 1.225;    ///< [kg/m3] density of air at 15 degrees C
constexpr double kEnergyOfTnt = 4.184e6; ///< [J/kg] energy of TNT, by definition

double kinneyGrahamOverpressure(double scaledDistance);   ///< [Pa]
double kingeryBulmashOverpressure(double scaledDistance); ///< [Pa]

/// Friedlander wave of equation (3), fitted to a history of overpressure.
struct FriedlanderWave
{
    double peak = 0;     ///< [Pa]
    double duration = 0; ///< [s]
    double decay = 0;    ///< [1] decay b of the wave
    double arrival = 0;  ///< [s]

    double at(double time) const;
};

struct PressureSample
{
    double time;         ///< [s]
    double overpressure; ///< [Pa]
};

/// Fits a wave to samples in the order of time. For a smeared shock, the arrival is the time at which half of
/// the rise is reached. The peak is the extrapolation of the decay curve to the arrival. If the samples
/// contain no complete positive phase, the peak is 0.
FriedlanderWave fitFriedlander(std::span<const PressureSample> samples);

} // namespace fx::sim
