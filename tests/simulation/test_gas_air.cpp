#include "simulation/gas/gas_air.h"

#include "foundation/memory/host_memory.h"
#include "simulation/sph/dynamics/state_equation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

using namespace fx::sim;

namespace {

FireParcel parcelOf(double temperature, double mixing)
{
    FireParcel parcel;
    parcel.temperature = temperature;
    parcel.mixing = mixing;
    return parcel;
}

StepContext stepIn(const glm::vec3& wind)
{
    return {12345, 1000, 3, 0, glm::vec3(0.0f), wind, 0.0f, nullptr, nullptr, nullptr, nullptr, nullptr};
}

} // namespace

TEST(GasThermodynamics, airAtItsOwnTemperatureHasItsOwnDensity)
{
    const GasThermodynamics thermo;
    EXPECT_NEAR(thermo.densityRatio(parcelOf(thermo.air.temperature, 1.0)), 1.0, 1e-12);
    EXPECT_NEAR(thermo.airDensity(), 1.204, 0.001);
}

TEST(GasThermodynamics, theEntropyGivesBackThePressureOfTheAir)
{
    const GasThermodynamics thermo{1.3, 83.0, {}};
    for (const double temperature : {300.0, 900.0, 2500.0})
        for (const double mixing : {1.0, 3.0, 1000.0}) {
            const FireParcel parcel = parcelOf(temperature, mixing);
            const double density = thermo.densityRatio(parcel) * thermo.airDensity();
            const double pressure = thermo.entropy(parcel) * std::pow(density, 1.3); // P = K rho^gamma
            EXPECT_NEAR(pressure, thermo.air.pressure, 1e-9 * pressure);
        }
}

TEST(GasThermodynamics, temperatureAndEntropyAreEachOthersInverse)
{
    const GasThermodynamics thermo{1.226, 274.6, {}};
    for (const double temperature : {293.15, 1200.0, 3450.0}) {
        const FireParcel parcel = parcelOf(temperature, 7.0);
        EXPECT_NEAR(thermo.potentialTemperature(thermo.entropy(parcel), 7.0), temperature,
                    1e-9 * temperature);
    }
}

TEST(GasThermodynamics, muchAirMakesItsGasConstantThatOfAir)
{
    const GasThermodynamics thermo{1.4, 83.0, {}};
    EXPECT_DOUBLE_EQ(thermo.gasConstant(1.0), 83.0);
    EXPECT_NEAR(thermo.gasConstant(1e6), kAirGasConstant, 1e-3);
    EXPECT_NEAR(thermo.gasConstant(2.0), 0.5 * (83.0 + kAirGasConstant), 1e-9); // half of each, by mass
}

TEST(GasAir, turbulenceOfManyPlacesIsThatOfEachAloneBitForBit)
{
    using Turbulence = GasAir::Turbulence;
    const GasDef def;
    const StepContext step = stepIn(glm::vec3(0.0f));
    const GasAir air(def, step, ThermalFlow{});
    fx::base::HostMemory memory;
    GasDynamicsDef dynamics;
    dynamics.capacity = Turbulence::kMax + 9;
    GasDynamics<float> gas(dynamics, &memory);
    std::vector<GasParticle> particles(dynamics.capacity);
    for (size_t i = 0; i < particles.size(); ++i)
        particles[i] = {glm::dvec3(0.37 * double(i) - 9.0, 0.1 * double(i), 0.7), {}, 1.0, 1.0};
    ASSERT_TRUE(gas.add(particles).ok());
    Turbulence many, one;
    float fastest = 0;
    for (const uint32_t count : {1u, 5u, 16u, 17u, Turbulence::kMax})
        for (const uint32_t first : {0u, 3u, 9u}) {
            many.evaluate(air, gas.view(), first, count);
            for (uint32_t k = 0; k < count; ++k) {
                one.evaluate(air, gas.view(), first + k, 1);
                EXPECT_EQ(many.at(k), one.at(0)) << first << "+" << k << " of " << count;
                fastest = std::max(fastest, std::abs(many.at(k).y));
            }
        }
    EXPECT_GT(fastest, 1.0f);
}

TEST(GasAir, turbulenceFadesAsTheGasCoolsAndIsOffWithoutStrength)
{
    GasDef def;
    def.curlStrength = 0.0f;
    const StepContext step = stepIn(glm::vec3(1.0f, 2.0f, 3.0f));
    const glm::vec3 gust(5.0f, 0.0f, 0.0f);
    const GasAir calm(def, step, ThermalFlow{});
    EXPECT_EQ(calm.velocity({}, 2000.0f, gust), step.wind); // switched off
    def.curlStrength = 2.5f;
    const GasAir rough(def, step, ThermalFlow{});
    EXPECT_EQ(rough.velocity({}, 2000.0f, gust), step.wind + gust);
    EXPECT_EQ(rough.velocity({}, 100.0f, gust), step.wind + 0.3f * gust); // cold gas is stirred less
}
