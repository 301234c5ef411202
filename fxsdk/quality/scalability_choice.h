/// @file scalability_choice.h
/// Chooses the settings with the smallest error within a time limit.
#pragma once

#include "fxsdk/quality/cost_model.h"

#include <span>

namespace fx::quality {

/// Inputs of a choice; all spans have one element per technique.
struct ChoiceInputs
{
    std::span<const ScalabilityLevels> techniqueLevels;
    const CostModel* costs;
    std::span<const double> weights; ///< [1] >= 0, importance of each technique on the screen
};

/// [ms] Time of a choice that the cost model predicts.
double predictedMilliseconds(const ChoiceInputs& in, const Choice& choice);
/// [1] Sum of the errors of the levels, weighted by the techniques' weights.
double estimatedError(const ChoiceInputs& in, const Choice& choice);

/// Raises levels, beginning at `from`, as long as `milliseconds` are not exceeded. Each time it takes the
/// rise with the largest decrease of error per millisecond; a rise may skip levels. Returns `from` if `from`
/// is already too slow.
/// @param most upper limit of the level of each technique
Choice climb(const ChoiceInputs& in, const Choice& from, const Choice& most, double milliseconds);

/// The highest level of each technique.
Choice highest(std::span<const ScalabilityLevels> techniqueLevels);

} // namespace fx::quality
