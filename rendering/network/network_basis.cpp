#include "rendering/network/network_basis.h"

#include <numbers>

namespace fx::render {

std::vector<NeighborDirection> neighborDirections(int count)
{
    constexpr double kSphere = 4.0 * std::numbers::pi;
    const std::array<double, 4> weights =
        count == 6    ? std::array<double, 4>{0.0, 1.0 / 6.0, 0.0, 0.0}                   // (1)
        : count == 14 ? std::array<double, 4>{0.0, 1.0 / 15.0, 0.0, 3.0 / 40.0}           // (2)
                      : std::array<double, 4>{0.0, 1.0 / 21.0, 4.0 / 105.0, 9.0 / 280.0}; // (3)
    std::vector<NeighborDirection> all;
    for (int i = 14; i < 27; ++i) { // of two opposite steps the one with the higher number
        const glm::ivec3 step(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
        const int squares = step.x * step.x + step.y * step.y + step.z * step.z;
        const double weight = kSphere * weights[size_t(squares)];
        if (weight == 0.0)
            continue;
        all.push_back({step, squares, weight});
        all.push_back({-step, squares, weight});
    }
    return all;
}

std::array<double, kMaxNetworkMoments> harmonics(const glm::dvec3& d)
{
    constexpr double kFirst = 0.48860251190291992, kSecond = 1.0925484305920792;
    return {0.28209479177387814,
            kFirst * d.y,
            kFirst * d.z,
            kFirst * d.x,
            kSecond * d.x * d.y,
            kSecond * d.y * d.z,
            0.31539156525252005 * (3.0 * d.z * d.z - 1.0),
            kSecond * d.x * d.z,
            0.5 * kSecond * (d.x * d.x - d.y * d.y)};
}

} // namespace fx::render
