/// @file units.h
/// Units that people type, and their size in the units of the preset format.
#pragma once

#include <span>
#include <string_view>

namespace fx::editor {

/// `name` is `factor` times the unit `of` of the schema, plus `offset`.
struct Unit
{
    std::string_view name;
    std::string_view of;
    double factor;
    double offset = 0.0;
};

std::span<const Unit> units();

} // namespace fx::editor
