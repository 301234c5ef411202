/// @file scalability_levels.h
/// What a technique costs and how wrong it is, setting by setting: the data that quality is chosen from.
#pragma once

#include "rendering/techniques/draw_techniques.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace fx::quality {

constexpr size_t kMostTechniques = 8; ///< techniques that are chosen at once
constexpr size_t kMostSteps = 16;     ///< of one technique

/// The settings of techniques that a step lowers; what is absent stays as the host has it.
struct Knobs
{
    std::optional<render::BillboardForm> billboards = std::nullopt;
    std::optional<bool> detail = std::nullopt;
    std::optional<float> particles = std::nullopt; ///< [1] share that is drawn, (0, 1]
    std::optional<bool> shimmer = std::nullopt;
    std::optional<float> lodBias = std::nullopt; ///< [1] of render::LodSettings, at least so much, [0, 256]
    std::optional<bool> dazzle = std::nullopt;
    std::optional<float> slicePlanes = std::nullopt;  ///< of a light, [3, 128]; four times as many texels
    std::optional<float> lightSamples = std::nullopt; ///< points of a ray through a ball that are lit, [1, 4]
    std::optional<bool> multiple = std::nullopt;      ///< light that is scattered more than once
};

/// One setting of a technique.
struct ScalabilityLevel
{
    double cost = 0;  ///< [1] time in units of the last step's, >= 0
    double error = 0; ///< [1] mean difference from the last step's picture, in units of the light in it
    Knobs knobs;
};

/// The settings of one technique worth having: each costs more than the one before and is less wrong.
struct ScalabilityLevels
{
    std::string technique;
    std::vector<ScalabilityLevel> steps; ///< 1 to kMostSteps
};

struct Calibration
{
    std::string origin; ///< machine and version that measured it
    std::vector<ScalabilityLevels> techniqueLevels;
};

/// The value of the setting that render::QualityKnob::name names; nothing: it is absent, or there is no such
/// one.
std::optional<float> valueOf(const Knobs& knobs, std::string_view name);
void setValue(std::string_view name, float value, Knobs& ioKnobs);

/// Calls f(knob) for every render::QualityKnob of the techniques, in their order.
template <class F>
void forEachKnob(F&& f, render::DrawTechniques techniques = render::drawTechniques())
{
    for (const render::DrawTechnique* technique : techniques)
        if (technique->levels)
            for (const render::QualityKnob& knob : technique->levels->knobs)
                f(knob);
}

/// What `first` sets, and what `second` sets besides.
Knobs merged(const Knobs& first, const Knobs& second);

/// Index of the step of each technique.
using Choice = std::array<uint8_t, kMostTechniques>;

/// Lowers `ioSettings` to what the knobs say. Never above what the host asked for.
void apply(const Knobs& knobs, render::ViewSettings& ioSettings);

} // namespace fx::quality
