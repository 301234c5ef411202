/// @file ambient_air.h
/// The ambient air of effects.
#pragma once

namespace fx::sim {

constexpr double kAirKelvin = 293.15;                ///< [K] temperature of the ambient air
constexpr float kAirTemperature = float(kAirKelvin); ///< [K] kAirKelvin in single precision

} // namespace fx::sim
