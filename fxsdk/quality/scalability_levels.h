/// @file scalability_levels.h
/// Cost and error of a technique at each level, from which quality is chosen.
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

constexpr size_t kMaxTechniques = 8; ///< techniques that are chosen at once
constexpr size_t kMaxSteps = 16;     ///< of one technique
constexpr size_t kMaxKnobs = 16;     ///< of all techniques

/// Settings that a step lowers, by render::QualityKnob::name; all others keep the host's values.
class Knobs
{
public:
    struct Setting
    {
        std::string_view name; ///< has static storage
        float value;           ///< as of render::QualityKnob::lower
    };

    Knobs() = default;
    Knobs(std::initializer_list<Setting> settings)
    {
        for (const Setting& setting : settings)
            set(setting.name, setting.value);
    }

    std::optional<float> valueOf(std::string_view name) const;
    void set(std::string_view name, float value); ///< no more than kMaxKnobs names

private:
    std::array<Setting, kMaxKnobs> settings_{};
    size_t count_ = 0;
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
    std::vector<ScalabilityLevel> steps; ///< 1 to kMaxSteps

    /// Composition of the views to which these levels apply; empty: all views whose composition has no levels
    /// of its own.
    std::optional<render::Composition> composition = {};
};

struct Calibration
{
    std::string origin; ///< machine and version that measured it
    std::vector<ScalabilityLevels> techniqueLevels;
};

/// The levels of each technique for views that ask for `composition`, in the order of the calibration.
std::vector<ScalabilityLevels> levelsFor(const Calibration& calibration, render::Composition composition);

/// Calls f(knob) for every render::QualityKnob of the techniques, in their order.
template <class F>
void forEachKnob(F&& f, render::DrawTechniques techniques = render::drawTechniques())
{
    for (const render::DrawTechnique* technique : techniques)
        if (technique->levels)
            for (const render::QualityKnob& knob : technique->levels->knobs)
                f(knob);
}

/// The knobs of `first`, and those of `second` that `first` lacks.
Knobs merged(const Knobs& first, const Knobs& second);

/// Index of the step of each technique.
using Choice = std::array<uint8_t, kMaxTechniques>;

/// Lowers `ioSettings` to the values of the knobs; never raises them.
void apply(const Knobs& knobs, render::ViewSettings& ioSettings);

} // namespace fx::quality
