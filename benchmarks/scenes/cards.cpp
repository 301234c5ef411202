#include "benchmarks/scenes/cards.h"

#include "foundation/random/philox.h"

#include <algorithm>
#include <cmath>

namespace fx::cli {
namespace {

constexpr double kPi = 3.14159265358979;
constexpr uint64_t kSeed = 270;

double random(uint32_t i, uint32_t k)
{
    return double(base::toUnitFloat(base::philox({i, k / 4, 1, 0}, kSeed)[k % 4]));
}

/// @param opticalDepth [1] through its middle
Card makeCard(uint32_t i, const std::array<double, 3>& place, double radius, double opticalDepth)
{
    return {float(place[0]),
            float(place[1]),
            float(place[2]),
            float(radius),
            float(opticalDepth * kPi * radius * radius / 3.5), // formula kernel-optical-depth (3)
            {float(random(i, 4)), float(random(i, 5)), float(random(i, 6))}};
}

} // namespace

std::vector<Card> isolatedCards(uint32_t count)
{
    const uint32_t columns = uint32_t(std::ceil(std::sqrt(1.6 * count)));
    const double cell = 2.4 / columns;
    std::vector<Card> cards;
    for (uint32_t i = 0; i < count; ++i) {
        const uint32_t rows = (count + columns - 1) / columns;
        const std::array<double, 3> place = {(i % columns + 0.5) * cell - 1.2,
                                             (i / columns + 0.5 - 0.5 * rows) * cell,
                                             1.0 + 2.0 * random(i, 2)};
        cards.push_back(makeCard(i, place, std::min(0.45 * cell, 0.6), 2.0));
    }
    return cards;
}

std::vector<Card> overlappingCards(uint32_t count)
{
    const double radius = count > 100 ? 0.3 : 0.6;
    const double each = 4.0 / (0.375 * count * radius * radius);
    std::vector<Card> cards;
    for (uint32_t i = 0; cards.size() < count; ++i) {
        const std::array<double, 3> p = {2 * random(i, 0) - 1, 2 * random(i, 1) - 1, 2 * random(i, 2) - 1};
        if (p[0] * p[0] + p[1] * p[1] + p[2] * p[2] <= 1.0)
            cards.push_back(makeCard(i, {p[0], 0.75 * p[1], p[2] + 2.0}, radius, std::min(each, 2.0)));
    }
    return cards;
}

} // namespace fx::cli
