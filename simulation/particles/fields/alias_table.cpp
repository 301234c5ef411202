#include "simulation/particles/fields/alias_table.h"

#include <algorithm>
#include <cmath>

namespace fx::sim {

AliasTable::AliasTable(std::span<const double> weights) : rows_(weights.size())
{
    const size_t n = weights.size();
    double sum = 0;
    std::vector<double> share(n);
    for (size_t i = 0; i < n; ++i) {
        share[i] = std::isfinite(weights[i]) && weights[i] > 0.0 ? weights[i] : 0.0;
        sum += share[i];
    }
    std::vector<uint32_t> small, large;
    for (size_t i = 0; i < n; ++i) {
        share[i] = sum > 0.0 ? share[i] / sum * double(n) : 1.0;
        rows_[i] = {1.0f, uint32_t(i)};
        (share[i] < 1.0 ? small : large).push_back(uint32_t(i));
    }
    while (!small.empty() && !large.empty()) { // (1)
        const uint32_t low = small.back(), high = large.back();
        small.pop_back();
        rows_[low] = {float(share[low]), high};
        share[high] -= 1.0 - share[low];
        if (share[high] < 1.0) {
            large.pop_back();
            small.push_back(high);
        }
    }
    // What is left differs from a full row by rounding only, unless it has hardly any weight itself.
    const auto heaviest = std::max_element(weights.begin(), weights.end());
    for (const uint32_t i : small)
        if (share[i] < 0.5)
            rows_[i] = {float(share[i]), uint32_t(heaviest - weights.begin())};
}

} // namespace fx::sim
