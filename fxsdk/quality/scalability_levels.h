/// @file scalability_levels.h
/// Cost and error of a technique at each level. Quality is chosen by them.
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
constexpr size_t kMaxKnobs = 16;     ///< maximum number of knobs of all techniques

/// Settings that a level lowers, by render::QualityKnob::name. All other settings keep the host's values.
class Knobs
{
public:
    struct Setting
    {
        std::string_view name; ///< has static storage
        float value;           ///< as for render::QualityKnob::lower
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

/// One setting of a technique.
struct ScalabilityLevel
{
    double cost = 0; ///< [1] time relative to the highest level, >= 0
    /// [1] mean difference from the picture of the highest level, relative to the light in that picture
    double error = 0;
    Knobs knobs;
};

/// The useful levels of one technique. Each level has a higher cost and a lower error than the one before.
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
    std::string origin; ///< machine and version with which the levels were measured
    std::vector<ScalabilityLevels> techniqueLevels;
};

/// The levels of each technique for views with `composition`, in the order of the calibration.
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

/// The knobs of `first`, and those of `second` that `first` does not contain.
Knobs merged(const Knobs& first, const Knobs& second);

/// Index of the chosen level of each technique.
using Choice = std::array<uint8_t, kMaxTechniques>;

/// Lowers `ioSettings` to the values of the knobs; never raises them.
void apply(const Knobs& knobs, render::ViewSettings& ioSettings);

} // namespace fx::quality
