#include "benchmarks/bench/instances/flight_pop.h"

#include <algorithm>
#include <cmath>

namespace fx::cli {
namespace {

constexpr float kNothing = 1.0f / 1024.0f; ///< a change that no display shows

float shown(float value)
{
    return value > 0.0f ? value / (1.0f + value) : 0.0f;
}

double quantile(std::vector<float> values, double share)
{
    if (values.empty())
        return 0.0;
    const auto at = values.begin() + std::ptrdiff_t(share * double(values.size() - 1));
    std::nth_element(values.begin(), at, values.end());
    return double(*at);
}

} // namespace

std::vector<float> blockChanges(std::span<const float> now, std::span<const float> before, int width,
                                int height)
{
    const int across = (width + kPopBlock - 1) / kPopBlock;
    const int down = (height + kPopBlock - 1) / kPopBlock;
    std::vector<float> changes(size_t(across) * size_t(down), 0.0f);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (size_t c = 0; c < 3; ++c) {
                const size_t at = 4 * (size_t(y) * size_t(width) + size_t(x)) + c;
                float& most = changes[size_t(y / kPopBlock) * size_t(across) + size_t(x / kPopBlock)];
                most = std::max(most, std::abs(shown(now[at]) - shown(before[at])));
            }
    return changes;
}

void FlightPop::add(std::span<const float> pops, std::span<const float> motion)
{
    for (size_t i = 0; i < pops.size(); ++i) {
        if (std::max(pops[i], motion[i]) < kNothing)
            continue;
        pops_.push_back(pops[i]);
        motion_.push_back(motion[i]);
    }
}

double FlightPop::largest() const
{
    return quantile(pops_, 1.0);
}

double FlightPop::p99() const
{
    return quantile(pops_, 0.99);
}

double FlightPop::motionLargest() const
{
    return quantile(motion_, 1.0);
}

double FlightPop::motionP99() const
{
    return quantile(motion_, 0.99);
}

} // namespace fx::cli
