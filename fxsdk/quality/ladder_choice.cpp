#include "fxsdk/quality/ladder_choice.h"

#include <algorithm>

namespace fx::quality {

namespace {

/// A way up, and what it gives.
struct Way
{
    size_t ladder = 0;
    uint8_t step = 0;
    double gain = -1.0; ///< error per millisecond; < 0: there is none
};

} // namespace

double predictedMilliseconds(const ChoiceInputs& in, const Choice& choice)
{
    double sum = 0.0;
    for (size_t i = 0; i < in.ladders.size(); ++i)
        sum += in.costs->scale(i) * in.ladders[i].steps[choice[i]].cost;
    return sum;
}

double estimatedError(const ChoiceInputs& in, const Choice& choice)
{
    double sum = 0.0;
    for (size_t i = 0; i < in.ladders.size(); ++i)
        sum += in.weights[i] * in.ladders[i].steps[choice[i]].error;
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
        for (size_t i = 0; i < in.ladders.size(); ++i) {
            const std::vector<LadderStep>& steps = in.ladders[i].steps;
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
        choice[best.ladder] = best.step;
        left -= bestCost;
    }
}

Choice highest(std::span<const Ladder> ladders)
{
    Choice choice{};
    for (size_t i = 0; i < ladders.size(); ++i)
        choice[i] = uint8_t(ladders[i].steps.size() - 1);
    return choice;
}

} // namespace fx::quality
