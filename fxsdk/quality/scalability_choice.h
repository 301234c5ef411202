/// @file scalability_choice.h
/// The settings that make least error within a time.
#pragma once

#include "fxsdk/quality/cost_model.h"

#include <span>

namespace fx::quality {

/// Inputs of a choice; all spans have one element per technique.
struct ChoiceInputs
{
    std::span<const ScalabilityLevels> techniqueLevels;
    const CostModel* costs;
    std::span<const double> weights; ///< [1] >= 0 how much each technique matters on the screen
};

/// [ms] that the model expects of a choice.
double predictedMilliseconds(const ChoiceInputs& in, const Choice& choice);
/// [1] sum of the errors of the steps, each times its weight.
double estimatedError(const ChoiceInputs& in, const Choice& choice);

/// Climbs from `from` by the step that takes most error away per millisecond, as long as `milliseconds` are
/// not exceeded. A step may skip others. Gives `from` back when that is too slow already.
/// @param most no technique goes above this
Choice climb(const ChoiceInputs& in, const Choice& from, const Choice& most, double milliseconds);

/// The last step of each technique.
Choice highest(std::span<const ScalabilityLevels> techniqueLevels);

} // namespace fx::quality
