#include "simulation/verification/lattice.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace fx::sim {

uint32_t evenSide(uint32_t particles, uint32_t least)
{
    const auto half = uint32_t(std::lround(0.5 * std::cbrt(double(particles))));
    return std::max(2 * half, least);
}

uint32_t evenAbove(double value)
{
    return 2 * uint32_t(std::ceil(0.5 * value));
}

double supportInSpacings(double neighbors)
{
    return std::cbrt(3 * neighbors / (4 * std::numbers::pi));
}

} // namespace fx::sim
