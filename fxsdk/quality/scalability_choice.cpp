#include "fxsdk/quality/scalability_choice.h"

#include <algorithm>

namespace fx::quality {

namespace {

/// A way up, and what it gives.
struct Way
{
    size_t technique = 0;
    uint8_t step = 0;
    double gain = -1.0; ///< error per millisecond; < 0: there is none
};

} // namespace

double predictedMilliseconds(const ChoiceInputs& in, const Choice& choice)
{
    double sum = 0.0;
    for (size_t i = 0; i < in.techniqueLevels.size(); ++i)
        sum += in.costs->scale(i) * in.techniqueLevels[i].steps[choice[i]].cost;
    return sum;
}

double estimatedError(const ChoiceInputs& in, const Choice& choice)
{
    double sum = 0.0;
    for (size_t i = 0; i < in.techniqueLevels.size(); ++i)
        sum += in.weights[i] * in.techniqueLevels[i].steps[choice[i]].error;
    return sum;
}

Choice climb(const ChoiceInputs& in, const Choice& from, const Choice& most, double milliseconds)
{
    constexpr double kFree = 1e-9; // [ms] what costs nothing as far as we know
    Choice choice = from;
    double left = milliseconds - predictedMilliseconds(in, choice);
    for (;;) {
        Way best;
        double bestCost = 0.0;
        for (size_t i = 0; i < in.techniqueLevels.size(); ++i) {
            const std::vector<ScalabilityLevel>& steps = in.techniqueLevels[i].steps;
            for (uint8_t k = uint8_t(choice[i] + 1); k <= most[i]; ++k) {
                const double cost = in.costs->scale(i) * (steps[k].cost - steps[choice[i]].cost);
                const double gain = in.weights[i] * (steps[choice[i]].error - steps[k].error);
                if (cost > left)
                    break;
                if (gain / std::max(cost, kFree) > best.gain) {
                    best = {i, k, gain / std::max(cost, kFree)};
                    bestCost = cost;
                }
            }
        }
        if (best.gain < 0.0)
            return choice;
        choice[best.technique] = best.step;
        left -= bestCost;
    }
}

Choice highest(std::span<const ScalabilityLevels> techniqueLevels)
{
    Choice choice{};
    for (size_t i = 0; i < techniqueLevels.size(); ++i)
        choice[i] = uint8_t(techniqueLevels[i].steps.size() - 1);
    return choice;
}

} // namespace fx::quality
