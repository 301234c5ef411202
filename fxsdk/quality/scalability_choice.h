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

/// [ms] Predicted time of a choice, from the cost model.
double predictedMilliseconds(const ChoiceInputs& in, const Choice& choice);
/// [1] Sum of the errors of the chosen levels, each times the weight of its technique.
double estimatedError(const ChoiceInputs& in, const Choice& choice);

/// Raises levels, beginning at `from`, within a predicted time of `milliseconds`. Each step is the raise
/// with the largest decrease of error per millisecond. A raise may skip levels. Returns `from` if `from` is
/// already too slow.
/// @param most upper limit of the level of each technique
Choice climb(const ChoiceInputs& in, const Choice& from, const Choice& most, double milliseconds);

/// Returns the highest level of each technique.
Choice highest(std::span<const ScalabilityLevels> techniqueLevels);

} // namespace fx::quality
