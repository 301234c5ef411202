/// @file materials.h
/// Measured properties of explosives and fuels: TNT, a petrol fireball, black powder. Quantities per kilogram
/// refer to the mass of the material itself ("own mass"), without mixed-in air. The file materials.cpp gives
/// the source of each number.
#pragma once

#include <span>
#include <string_view>

namespace fx::sim {

/// Constants of the Jones-Wilkins-Lee equation of the products of a detonation; all zero without a
/// detonation.
struct JwlConstants
{
    double a = 0;  ///< [Pa]
    double b = 0;  ///< [Pa]
    double r1 = 0; ///< [1]
    double r2 = 0; ///< [1]
    /// [1] Grueneisen coefficient; the ratio of specific heats at large expansion is 1 + omega
    double omega = 0;
    double energy = 0;  ///< [J/m3] energy per volume of the unreacted material
    double density = 0; ///< [kg/m3] density of the unreacted material
    double speed = 0;   ///< [m/s] speed of the detonation
};

/// Extinction by one kind of particles, per kilogram of particles.
struct ParticleOptics
{
    double extinction; ///< [m2/kg] extinction of visible light
    double albedo;     ///< [1] single scattering albedo
};

struct Material
{
    std::string_view name; ///< name in presets

    /// [J/kg] energy per mass by which the member `energy` of a preset is converted to a mass
    double nominalEnergy;
    double heatAtStart;      ///< [J/kg] heat that a detonation or a bursting vessel releases at the start
    double heatOfCombustion; ///< [J/kg] heat released by combustion
    double airNeeded;        ///< [kg/kg] mass of air for complete combustion
    double ownOxygen;        ///< [1] fraction of the material that burns without air, 0..1
    double burningAtStart;   ///< [1] fraction of the material that is burning at the start, 0..1

    double gasConstant;      ///< [J/(kg K)] gas constant at the start, per kilogram of material
    double startTemperature; ///< [K] temperature of the gas at the start
    /// [J/(kg K)] heat capacity of gas and air at constant pressure, mean over 300..2300 K
    double heatCapacity;
    double startSpeed; ///< [m/s] surface speed of the content of a bursting vessel

    double ignitionTemperature; ///< [K]
    double ignitionDelay;       ///< [s] mean time to ignite, well above ignitionTemperature
    double burnTime;            ///< [s] mean time to burn with sufficient air

    double flameSoot; ///< [1] mass of soot in the burning gas, per own mass
    double smokeSoot; ///< [1] mass of soot left by the burnt gas, per own mass
    double smokeSalt; ///< [1] mass of pale solids left by the burnt gas, per own mass

    double fireballDiameter; ///< [m/kg^(1/3)] coefficient of the diameter
    double fireballDuration; ///< [s/kg^(1/3)] coefficient of the duration below `largeMass`
    /// [kg] mass above which buoyancy dominates, so that the duration grows with mass^(1/6); 0: there is no
    /// such mass
    double largeMass;
    double largeDuration; ///< [s/kg^(1/6)] coefficient of the duration above `largeMass`

    JwlConstants jwl;
};

/// Optical properties of soot from flames, and of pale smoke from salts.
extern const ParticleOptics kSootOptics;
extern const ParticleOptics kSaltOptics;

/// All materials that presets can name.
std::span<const Material> materials();
/// Finds a material by name; null if there is none.
const Material* findMaterial(std::string_view name);

constexpr double kTntEquivalent = 4.184e6; ///< [J/kg] energy of TNT, by definition

} // namespace fx::sim
