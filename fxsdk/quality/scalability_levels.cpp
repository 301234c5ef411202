#include "fxsdk/quality/scalability_levels.h"

#include <algorithm>
#include <cassert>

namespace fx::quality {

std::optional<float> Knobs::valueOf(std::string_view name) const
{
    const auto end = settings_.begin() + ptrdiff_t(count_);
    const auto found = std::find_if(settings_.begin(), end, [&](const Setting& s) { return s.name == name; });
    return found != end ? std::optional(found->value) : std::nullopt;
}

void Knobs::set(std::string_view name, float value)
{
    const auto end = settings_.begin() + ptrdiff_t(count_);
    const auto found = std::find_if(settings_.begin(), end, [&](const Setting& s) { return s.name == name; });
    assert(found != settings_.end());
    *found = {name, value};
    if (found == end)
        ++count_;
}

void apply(const Knobs& knobs, render::ViewSettings& ioSettings)
{
    forEachKnob([&](const render::QualityKnob& knob) {
        if (const std::optional<float> value = knobs.valueOf(knob.name))
            knob.lower(*value, ioSettings);
    });
}

std::vector<ScalabilityLevels> levelsFor(const Calibration& calibration, render::Composition composition)
{
    std::vector<ScalabilityLevels> chosen;
    for (const ScalabilityLevels& levels : calibration.techniqueLevels) {
        if (levels.composition && levels.composition != composition)
            continue;
        const auto same = std::ranges::find(chosen, levels.technique, &ScalabilityLevels::technique);
        if (same == chosen.end())
            chosen.push_back(levels);
        else if (levels.composition)
            *same = levels;
    }
    return chosen;
}

Knobs merged(const Knobs& first, const Knobs& second)
{
    Knobs both = second;
    forEachKnob([&](const render::QualityKnob& knob) {
        if (const std::optional<float> value = first.valueOf(knob.name))
            both.set(knob.name, *value);
    });
    return both;
}

} // namespace fx::quality
