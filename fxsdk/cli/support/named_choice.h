/// @file named_choice.h
/// Command-line options whose value is one of several names.
#pragma once

#include "foundation/result/nearest_name.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace fx::cli {

/// Accepts one of `names`. The message for any other value lists the names and suggests the nearest name.
inline CLI::Validator oneOf(std::vector<std::string> names)
{
    const std::string list = "{" + CLI::detail::join(names, ",") + "}";
    const auto check = [names = std::move(names), list](std::string& text) -> std::string {
        if (std::find(names.begin(), names.end(), text) != names.end())
            return {};
        return "\"" + text + "\" is not one of " + list + base::didYouMean(text, names);
    };
    return CLI::Validator(check, list);
}

} // namespace fx::cli
