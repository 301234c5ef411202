#include "fxsdk/editor/inspector/units.h"

#include <array>
#include <numbers>

namespace fx::editor {

namespace {

constexpr double kDegreesPerRadian = 180.0 / std::numbers::pi;

/// Foot and inch are international; a revolution per minute is 6 degrees per second.
constexpr auto kUnits = std::to_array<Unit>({
    {"mm", "m", 1e-3},
    {"cm", "m", 1e-2},
    {"m", "m", 1.0},
    {"km", "m", 1e3},
    {"in", "m", 0.0254},
    {"ft", "m", 0.3048},
    {"cm2", "m2", 1e-4},
    {"m2", "m2", 1.0},
    {"ms", "s", 1e-3},
    {"s", "s", 1.0},
    {"min", "s", 60.0},
    {"h", "s", 3600.0},
    {"m/s", "m/s", 1.0},
    {"cm/s", "m/s", 1e-2},
    {"km/h", "m/s", 1.0 / 3.6},
    {"mph", "m/s", 0.44704},
    {"m/s2", "m/s2", 1.0},
    {"g", "m/s2", 9.80665},
    {"1/s", "1/s", 1.0},
    {"Hz", "1/s", 1.0},
    {"1/min", "1/s", 1.0 / 60.0},
    {"degree", "degree", 1.0},
    {"deg", "degree", 1.0},
    {"rad", "degree", kDegreesPerRadian},
    {"degree/s", "degree/s", 1.0},
    {"deg/s", "degree/s", 1.0},
    {"rad/s", "degree/s", kDegreesPerRadian},
    {"rpm", "degree/s", 6.0},
    {"K", "K", 1.0},
    {"C", "K", 1.0, 273.15},
    {"J", "J", 1.0},
    {"kJ", "J", 1e3},
    {"MJ", "J", 1e6},
    {"g", "kg", 1e-3},
    {"kg", "kg", 1.0},
    {"t", "kg", 1e3},
    {"%", "1", 1e-2},
});

} // namespace

std::span<const Unit> units()
{
    return kUnits;
}

} // namespace fx::editor
