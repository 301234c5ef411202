#include "benchmarks/stability/stability_row.h"

#include <algorithm>
#include <cmath>

namespace fx::cli {

StabilityAxis evenSteps(std::string name, double from, double to, uint32_t steps, bool isQuick)
{
    StabilityAxis axis{std::move(name), {}};
    const uint32_t count = isQuick ? std::max(steps / 5, 4u) : steps;
    for (uint32_t i = 0; i <= count; ++i)
        axis.values.push_back(from + (to - from) * i / count);
    return axis;
}

StabilityAxis powersOfTen(std::string name, double from, double to, uint32_t perDecade, bool isQuick)
{
    const double steps = std::max(1.0, std::round((to - from) * perDecade));
    StabilityAxis axis = evenSteps(std::move(name), from, to, uint32_t(steps), isQuick);
    for (double& value : axis.values)
        value = std::pow(10.0, value);
    return axis;
}

StabilityAxis values(std::string name, std::vector<double> list)
{
    return {std::move(name), std::move(list)};
}

StabilitySweep controlOf(const StabilitySweep& sweep, std::string name,
                         std::function<double(double x, double y)> error)
{
    return {std::move(name), sweep.x, sweep.y, sweep.limit, true, std::move(error)};
}

const std::vector<StabilityRow>& stabilityRows()
{
    static const std::vector<StabilityRow> kRows = [] {
        std::vector<StabilityRow> all;
        for (const StabilityRows& part : stabilityRowGroups())
            all.insert(all.end(), part.begin(), part.end());
        std::stable_sort(all.begin(), all.end(), [](const StabilityRow& a, const StabilityRow& b) {
            const auto order = [](std::string_view id) { return std::string_view("RBLHD").find(id[0]); };
            return order(a.id) != order(b.id) ? order(a.id) < order(b.id) : a.id < b.id;
        });
        return all;
    }();
    return kRows;
}

} // namespace fx::cli
