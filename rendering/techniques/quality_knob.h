/// @file quality_knob.h
/// Scalability of a technique: the settings that form its scalability levels.
#pragma once

#include "rendering/frame/fragment_counts.h"
#include "rendering/frame/view_types.h"

#include <cstdint>
#include <span>
#include <string_view>

namespace fx::render {

/// A setting of a technique that quality control may lower. Its value is a number. The value of a switch is 0
/// or 1, that of a choice is the index of the name.
struct QualityKnob
{
    enum class Type : uint8_t
    {
        Number,
        Choice,
        Switch,
    };

    std::string_view name;  ///< name in calibrations
    std::string_view label; ///< text before a displayed value; for a choice, only the name is displayed
    Type type;
    std::span<const std::string_view> choices; ///< names of a choice, cheapest first; otherwise empty
    std::string_view schema;                   ///< JSON Schema of the value in calibrations

    /// Lowers the setting to `value`; never raises it.
    void (*lower)(float value, ViewSettings& ioSettings);
};

/// Adjustable settings of a technique. Calibrations measure cost and error of their levels.
struct ScalabilitySettings
{
    std::string_view name;    ///< name in calibrations, and name of the timer group; empty: none
    std::string_view meaning; ///< description in the schema of calibrations

    /// [1] Weight of an error of this technique in a picture.
    double (*weight)(const ScreenShare& covered);

    std::span<const QualityKnob> knobs;
};

} // namespace fx::render
