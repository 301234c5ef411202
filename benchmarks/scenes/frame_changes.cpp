#include "benchmarks/scenes/frame_changes.h"

#include "foundation/math/bits.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace fx::cli {

namespace {

double medianOf(std::vector<double> values)
{
    if (values.empty())
        return 0.0;
    const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

} // namespace

double meanChange(std::span<const float> before, std::span<const float> after,
                  const std::vector<bool>& coveredBefore, const std::vector<bool>& coveredAfter)
{
    double sum = 0.0;
    size_t count = 0;
    for (size_t i = 0; i < before.size(); ++i) {
        if (!coveredBefore[i] && !coveredAfter[i])
            continue;
        sum += std::abs(double(after[i]) - double(before[i]));
        ++count;
    }
    return count > 0 ? sum / double(count) : 0.0;
}

ChangeJudgment judgeChanges(std::span<const double> changes, std::span<const double> reference,
                            const ChangeBound& bound)
{
    ChangeJudgment judgment;
    judgment.medianReference = medianOf({reference.begin(), reference.end()});
    std::vector<double> ratios;
    for (size_t k = 0; k < reference.size(); ++k) {
        const double least = bound.share * judgment.medianReference;
        const double left = (bound.factor - 1.0) * reference[k] + least;
        double excess = std::max(changes[k] - reference[k], 0.0) / std::max(left, 1e-30);
        if (!base::isFinite(changes[k]))
            excess = std::numeric_limits<double>::infinity();
        judgment.excess.push_back(excess);
        judgment.beyond += excess > 1.0 ? 1 : 0;
        if (excess > judgment.excess[judgment.worst])
            judgment.worst = k;
        ratios.push_back(changes[k] / std::max(reference[k], 1e-30));
    }
    judgment.medianRatio = medianOf(std::move(ratios));
    return judgment;
}

} // namespace fx::cli
