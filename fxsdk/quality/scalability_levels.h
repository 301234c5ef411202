/// @file scalability_levels.h
/// Cost and error of a technique at each level. The budget controller chooses levels by cost and error.
#pragma once

#include "rendering/techniques/draw_techniques.h"

#include <array>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace fx::quality {

constexpr size_t kMaxTechniques = 8; ///< maximum number of techniques in a choice
constexpr size_t kMaxSteps = 16;     ///< maximum number of levels of one technique
constexpr size_t kMaxKnobs = 16;     ///< maximum number of knobs (settings) of all techniques

/// Settings (knobs) that a level lowers, by render::QualityKnob::name. All other settings keep the host's
/// values.
class Knobs
{
public:
    struct Setting
    {
        std::string_view name; ///< has static storage
        float value;           ///< argument of render::QualityKnob::lower
    };

    Knobs() = default;
    Knobs(std::initializer_list<Setting> settings)
    {
        for (const Setting& setting : settings)
            set(setting.name, setting.value);
    }

    std::optional<float> valueOf(std::string_view name) const;
    void set(std::string_view name, float value); ///< at most kMaxKnobs names

private:
    std::array<Setting, kMaxKnobs> settings_{};
    size_t count_ = 0;
};

/// One quality level of a technique.
struct ScalabilityLevel
{
    double cost = 0; ///< [1] time relative to the highest level, >= 0
    /// [1] mean difference from the picture of the highest level, divided by the mean light of that picture
    double error = 0;
    Knobs knobs;
};

/// The useful levels of one technique. Each level has a higher cost and a lower error than the previous
/// level.
struct ScalabilityLevels
{
    std::string technique;
    std::vector<ScalabilityLevel> steps; ///< 1 to kMaxSteps

    /// Composition of the views to which the levels apply. Empty: the levels apply to all compositions
    /// without specific levels.
    std::optional<render::Composition> composition = {};
};

struct Calibration
{
    std::string origin; ///< machine and version with which the levels were measured
    std::vector<ScalabilityLevels> techniqueLevels;
};

/// Returns the levels of each technique for views with `composition`, in the order of the calibration.
std::vector<ScalabilityLevels> levelsFor(const Calibration& calibration, render::Composition composition);

/// Calls f(knob) for every render::QualityKnob of the techniques, in the order of techniques.
template <class F>
void forEachKnob(F&& f, render::DrawTechniques techniques = render::drawTechniques())
{
    for (const render::DrawTechnique* technique : techniques)
        if (technique->levels)
            for (const render::QualityKnob& knob : technique->levels->knobs)
                f(knob);
}

/// Returns the knobs of `first`, and the knobs of `second` that are not in `first`.
Knobs merged(const Knobs& first, const Knobs& second);

/// For each technique, index of the chosen level.
using Choice = std::array<uint8_t, kMaxTechniques>;

/// Lowers `ioSettings` to the values of the knobs. Settings are never raised.
void apply(const Knobs& knobs, render::ViewSettings& ioSettings);

} // namespace fx::quality
