/// @file quality_knob.h
/// Scalability of a technique: the settings that form its scalability levels.
#pragma once

#include "rendering/frame/fragment_counts.h"
#include "rendering/frame/view_types.h"

#include <cstdint>
#include <span>
#include <string_view>

namespace fx::render {

/// A setting of a technique that quality control may lower. The value of a setting is a number. It is 0 or 1
/// for a switch, and the index of the name for a choice.
struct QualityKnob
{
    enum class Type : uint8_t
    {
        Number,
        Choice,
        Switch,
    };

    std::string_view name; ///< name in calibrations
    /// Text that is displayed before the value; for a choice, only the name of the value is displayed.
    std::string_view label;
    Type type;
    /// Names of the values of a choice, cheapest first; empty if the setting is not a choice.
    std::span<const std::string_view> choices;
    std::string_view schema; ///< JSON Schema of the setting's value in calibrations

    /// Sets the setting to `value` if `value` is lower than the present value.
    void (*lower)(float value, ViewSettings& ioSettings);
};

/// Adjustable settings of a technique. Calibrations measure the cost and the error of their values.
struct ScalabilitySettings
{
    std::string_view name; ///< name in calibrations, which is also the name of the timer group; empty: none
    std::string_view meaning; ///< description of the technique in the schema of calibrations

    /// [1] Returns the weight of an error of this technique in a picture. `covered` has the fractions of the
    /// picture that the techniques cover.
    double (*weight)(const ScreenShare& covered);

    std::span<const QualityKnob> knobs;
};

} // namespace fx::render
