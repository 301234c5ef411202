#include "fxsdk/quality/scalability_levels.h"

#include <algorithm>
#include <type_traits>
#include <utility>

namespace fx::quality {

namespace {

/// Calls f(name, member) for every member of `knobs`.
template <class K, class F>
void forEachMember(K& knobs, F&& f)
{
    f("billboards", knobs.billboards);
    f("detail", knobs.detail);
    f("particles", knobs.particles);
    f("shimmer", knobs.shimmer);
    f("lodBias", knobs.lodBias);
    f("dazzle", knobs.dazzle);
    f("slicePlanes", knobs.slicePlanes);
    f("lightSamples", knobs.lightSamples);
    f("multiple", knobs.multiple);
}

} // namespace

std::optional<float> valueOf(const Knobs& knobs, std::string_view name)
{
    std::optional<float> value;
    forEachMember(knobs, [&](std::string_view member, const auto& setting) {
        if (member == name && setting)
            value = float(*setting);
    });
    return value;
}

void setValue(std::string_view name, float value, Knobs& ioKnobs)
{
    forEachMember(ioKnobs, [&](std::string_view member, auto& setting) {
        using Value = typename std::remove_reference_t<decltype(setting)>::value_type;
        if (member == name)
            setting = Value(value);
    });
}

void apply(const Knobs& knobs, render::ViewSettings& ioSettings)
{
    forEachKnob([&](const render::QualityKnob& knob) {
        if (const std::optional<float> value = valueOf(knobs, knob.name))
            knob.lower(*value, ioSettings);
    });
}

Knobs merged(const Knobs& first, const Knobs& second)
{
    Knobs both = second;
    forEachKnob([&](const render::QualityKnob& knob) {
        if (const std::optional<float> value = valueOf(first, knob.name))
            setValue(knob.name, *value, both);
    });
    return both;
}

} // namespace fx::quality
