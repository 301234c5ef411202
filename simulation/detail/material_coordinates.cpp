#include "simulation/detail/material_coordinates.h"

#include <algorithm>
#include <cmath>

namespace fx::sim {

uint64_t GenerationClock::advance(double shear, double seconds)
{
    fade_ += std::min(shear / kShearOfGeneration, kMaxGenerationRate * seconds); // (2)
    const double whole = std::floor(fade_);
    fade_ -= whole;
    younger_ += uint64_t(whole);
    return uint64_t(whole);
}

MaterialCoordinates::MaterialCoordinates(std::pmr::memory_resource* memory, uint32_t capacity)
{
    for (base::Column<float>& column : columns_) {
        column = base::Column<float>(memory, capacity);
        std::fill_n(column.data(), capacity, 0.0f);
    }
}

} // namespace fx::sim
