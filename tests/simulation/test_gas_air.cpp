#include "simulation/sph/gas_air.h"

#include "simulation/sph/dynamics/state_equation.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace fx::sim;

namespace {

FireParcel parcelOf(double temperature, double mixing)
{
    FireParcel parcel;
    parcel.temperature = temperature;
    parcel.mixing = mixing;
    return parcel;
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
