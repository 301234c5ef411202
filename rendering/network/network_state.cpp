#include "rendering/network/network_state.h"

#include "rendering/network/cell_interpolation.h"

#include <algorithm>

namespace fx::render {

double interpolated(const float* values, const NetworkGrid& grid, const glm::dvec3& position)
{
    const glm::dvec3 place = (position - grid.corner) / grid.side;
    const BetweenCells x(place.x, grid.cells.x), y(place.y, grid.cells.y), z(place.z, grid.cells.z);
    const auto row = [&](int j, int k) {
        const float* r = values + grid.index({0, j, k});
        return double(r[x.first]) + x.share * (double(r[x.second]) - double(r[x.first]));
    };
    const auto plane = [&](int k) {
        const double first = row(y.first, k);
        return first + y.share * (row(y.second, k) - first);
    };
    const double first = plane(z.first);
    return first + z.share * (plane(z.second) - first);
}

NetworkState resampled(const NetworkState& state, const NetworkGrid& grid, int moments)
{
    NetworkState out{grid, moments, std::vector<float>(grid.count() * size_t(moments), 0.0f)};
    for (int m = 0; m < std::min(moments, state.moments); ++m) {
        const float* from = state.light.data() + size_t(m) * state.grid.count();
        float* to = out.light.data() + size_t(m) * grid.count();
        for (int k = 0; k < grid.cells.z; ++k)
            for (int j = 0; j < grid.cells.y; ++j)
                for (int i = 0; i < grid.cells.x; ++i)
                    *to++ = float(interpolated(from, state.grid, grid.middle({i, j, k})));
    }
    return out;
}

} // namespace fx::render
