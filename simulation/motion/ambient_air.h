/// @file ambient_air.h
/// The air that effects start in.
#pragma once

namespace fx::sim {

constexpr double kAirKelvin = 293.15;                ///< [K] temperature of the ambient air
constexpr float kAirTemperature = float(kAirKelvin); ///< [K] the same in single precision

} // namespace fx::sim
