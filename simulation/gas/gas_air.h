/// @file gas_air.h
/// The air around an explosion: wind, circulation of the rising cloud, turbulence and thermodynamics.
#pragma once

#include "simulation/combustion/charge_plan.h"
#include "simulation/combustion/fire_parcel.h"
#include "simulation/gas/gas_def.h"
#include "simulation/gas/gas_thermal.h"
#include "simulation/motion/curl_noise.h"
#include "simulation/solver/solver.h"
#include "simulation/sph/dynamics/gas_dynamics.h"

namespace fx::sim {

constexpr double kAirGasConstant = 287.05; ///< [J/(kg K)]

/// The air's velocity during one step.
class GasAir
{
public:
    GasAir(const GasDef& def, const StepContext& step, const ThermalFlow& thermal);

    /// Turbulence at the full strength of flames. The turbulence is evaluated at several positions at once,
    /// because a SIMD vector of positions takes little more time than one position.
    class Turbulence
    {
    public:
        static constexpr uint32_t kMax = 64; ///< largest number of positions

        /// Evaluates the turbulence at the particles in the slots [first, first + count) of the gas.
        void evaluate(const GasAir& air, const GasView<float>& gas, uint32_t first, uint32_t count);
        glm::vec3 at(uint32_t k) const { return {velocity_[0][k], velocity_[1][k], velocity_[2][k]}; }

    private:
        alignas(64) float position_[3][kMax] = {}; ///< [m]
        alignas(64) float velocity_[3][kMax];      ///< [m/s]
    };

    /// [m/s] Velocity at `position`, around gas of `temperature` [K]. Turbulence decreases as the gas cools.
    glm::vec3 velocity(const glm::vec3& position, float temperature, const glm::vec3& turbulence) const;
    const ThermalFlow& thermal() const { return thermal_; }

private:
    const GasDef& def_;
    glm::vec3 wind_;
    CurlNoise noise_;
    ThermalFlow thermal_;
};

/// @formula potential-temperature
/// The entropy of a parcel as a function of its temperature at the air's pressure.
///
/// symbol   unit        meaning
///   K       Pa (m3/kg)^gamma   entropy function, P = K rho^gamma
///   theta   K           temperature at the air's pressure
///   P_a     Pa          the air's pressure
///   R_f, R_a  J/(kg K)  gas constants of the material's gas and of air
///   M       1           mass of the parcel, including mixed-in air, over its own mass
///   tau     1           density at the air's pressure over the density of the air
/// @derivation
///   R = (R_f + (M - 1) R_a) / M                                  (1)
///   rho_e = P_a / (R theta), tau = rho_e / rho_a                 (2)
///   K = P_a / rho_e^gamma = P_a^(1-gamma) (R theta)^gamma        (3)
///   theta = (K P_a^(gamma-1))^(1/gamma) / R                      (4)
/// @source    textbook (ideal gas; potential temperature of meteorology)
/// @deviation none
/// @valid     theta, K > 0
/// @accuracy  (4) undoes (3) to 1e-9
/// @tests     tests/simulation/test_gas_air.cpp
struct GasThermodynamics
{
    double gamma = 1.4;
    double fuelGasConstant = kAirGasConstant; ///< [J/(kg K)]
    AmbientAir air;

    double gasConstant(double mixing) const
    {
        return (fuelGasConstant + (mixing - 1.0) * kAirGasConstant) / mixing;
    }
    double densityRatio(const FireParcel& parcel)
        const; ///< [1] density at the air's pressure divided by the density of the air
    double entropy(const FireParcel& parcel) const; ///< entropy function K of the formula
    double potentialTemperature(double entropy,
                                double mixing) const; ///< [K] temperature at the air's pressure
    double airDensity() const { return air.pressure / (kAirGasConstant * air.temperature); } ///< [kg/m3]
};

} // namespace fx::sim
