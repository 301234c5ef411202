/// @file nearest_name.h
/// Finds the known name that is nearest to a misspelled name.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace fx::base {

/// The edit distance of `a` and `b`: the smallest number of insertions, deletions, substitutions and
/// transpositions of adjacent letters that convert `a` into `b`. Letter case is ignored (restricted
/// Damerau-Levenshtein distance). Only the first 64 bytes of a name are compared.
size_t editDistance(std::string_view a, std::string_view b);

/// The element of `known` with the smallest edit distance to `name`; nothing if all distances are too large.
/// The distance to an element may be at most a third of its length, or 2 for short elements.
std::optional<std::string> nearestName(std::string_view name, std::span<const std::string> known);

/// The text `; did you mean "NAME"?` to append to a message, where NAME is nearestName(); empty if
/// nearestName() returns nothing.
std::string didYouMean(std::string_view name, std::span<const std::string> known);

} // namespace fx::base
