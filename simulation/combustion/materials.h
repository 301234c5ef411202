/// @file materials.h
/// Measured properties of explosives and fuels: TNT, a petrol fireball, black powder. Quantities per kilogram
/// refer to the mass of the material itself ("own mass"), without mixed-in air. materials.cpp gives the
/// source of each.
#pragma once

#include <span>
#include <string_view>

namespace fx::sim {

/// Constants of the Jones-Wilkins-Lee equation of the products of a detonation; all zero without a
/// detonation.
struct JwlConstants
{
    double a = 0;       ///< [Pa]
    double b = 0;       ///< [Pa]
    double r1 = 0;      ///< [1]
    double r2 = 0;      ///< [1]
    double omega = 0;   ///< [1] Grueneisen coefficient; gamma of the far expansion is 1 + omega
    double energy = 0;  ///< [J/m3] of the unreacted volume
    double density = 0; ///< [kg/m3] of the unreacted material
    double speed = 0;   ///< [m/s] of the detonation
};

/// Extinction by one kind of particles, per kilogram of particles.
struct ParticleOptics
{
    double extinction; ///< [m2/kg] in the visible
    double albedo;     ///< [1] share that scatters
};

struct Material
{
    std::string_view name; ///< name in presets

    double nominalEnergy;    ///< [J/kg] converts `energy` of a preset to a mass
    double heatAtStart;      ///< [J/kg] heat that exists at the start: a detonation, a bursting casing
    double heatOfCombustion; ///< [J/kg] released as the gas burns
    double airNeeded;        ///< [kg/kg] air that complete combustion takes in
    double ownOxygen;        ///< [1] share that burns without air, 0..1
    double burningAtStart;   ///< [1] share that burns at the start, 0..1

    double gasConstant;      ///< [J/(kg K)] of the gas at the start, per kilogram of material
    double startTemperature; ///< [K] of the gas at the start
    double heatCapacity;     ///< [J/(kg K)] of gas and air at constant pressure, mean over 300..2300 K
    double startSpeed;       ///< [m/s] speed of the content of a bursting vessel at its surface

    double ignitionTemperature; ///< [K]
    double ignitionDelay;       ///< [s] mean time to ignite when well above it
    double burnTime;            ///< [s] mean time to burn with all the air it needs

    double flameSoot; ///< [1] mass of soot in the burning gas, per own mass
    double smokeSoot; ///< [1] mass of soot left by the burnt gas, per own mass
    double smokeSalt; ///< [1] mass of pale solids left by the burnt gas, per own mass

    double fireballDiameter; ///< [m/kg^(1/3)]
    double fireballDuration; ///< [s/kg^(1/3)] below `largeMass`
    /// [kg] mass above which buoyancy dominates and the duration grows with m^(1/6); 0: never
    double largeMass;
    double largeDuration; ///< [s/kg^(1/6)]

    JwlConstants jwl;
};

/// Soot from flames, and pale smoke of salts.
extern const ParticleOptics kSootOptics;
extern const ParticleOptics kSaltOptics;

/// All materials that presets can name.
std::span<const Material> materials();
/// The material of that name, or null.
const Material* findMaterial(std::string_view name);

constexpr double kTntEquivalent = 4.184e6; ///< [J/kg] by definition

} // namespace fx::sim
