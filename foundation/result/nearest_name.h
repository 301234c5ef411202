/// @file nearest_name.h
/// Finds the known name that is nearest to a misspelled one.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace fx::base {

/// The edit distance of `a` and `b`: the smallest number of insertions, deletions, substitutions and
/// transpositions of adjacent letters that convert `a` into `b`. Letter case is ignored (restricted
/// Damerau-Levenshtein distance). Of longer names only the first 64 bytes count.
size_t editDistance(std::string_view a, std::string_view b);

/// The closest of `known`, or nothing when all differ by more than a third of their letters.
std::optional<std::string> nearestName(std::string_view name, std::span<const std::string> known);

/// `; did you mean "NAME"?` with the closest of `known`, to end a message with; empty when none is near.
std::string didYouMean(std::string_view name, std::span<const std::string> known);

} // namespace fx::base
