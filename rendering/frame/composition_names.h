/// @file composition_names.h
/// Names of compositions in scene files and options.
#pragma once

#include "rendering/frame/view_types.h"

#include <string_view>
#include <utility>

namespace fx::render {

inline constexpr std::pair<std::string_view, Composition> kCompositionNames[] = {
    {"sorted", Composition::Sorted},
    {"slabs", Composition::Slabs},
    {"volume", Composition::Volume},
    {"automatic", Composition::Automatic},
};

/// Returns the name of a composition; empty if the value has no name.
constexpr std::string_view nameOf(Composition composition)
{
    for (const auto& [name, value] : kCompositionNames)
        if (value == composition)
            return name;
    return {};
}

} // namespace fx::render
