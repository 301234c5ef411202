/// @file flow_gradient.h
/// Divergence and curl of a flow from moments of a neighborhood, by equations (5) and (6) of formula
/// gas-density.
#pragma once

#include <array>
#include <cmath>

namespace fx::sim {

template <class T>
struct FlowGradient
{
    T divergence; ///< [1/s]
    T curl;       ///< [1/s] magnitude of the curl of the velocity
};

/// Computes divergence and curl from the sums M and G of gas-density.
/// @param moments M_xx, M_xy, M_xz, M_yy, M_yz, M_zz
/// @param flows G_xx, G_xy, G_xz, G_yx, ... G_zz
template <class T>
FlowGradient<T> flowGradient(const T* moments, const T* flows)
{
    const T trace = moments[0] + moments[3] + moments[5];
    if (!(trace > T(0)))
        return {T(0), T(0)};
    const T scale = T(1) / trace; // so that products of three moments stay in range
    std::array<T, 6> m;
    for (size_t k = 0; k < 6; ++k)
        m[k] = moments[k] * scale;
    std::array<T, 6> inverse{m[3] * m[5] - m[4] * m[4], m[2] * m[4] - m[1] * m[5], m[1] * m[4] - m[2] * m[3],
                             m[0] * m[5] - m[2] * m[2], m[1] * m[2] - m[0] * m[4], m[0] * m[3] - m[1] * m[1]};
    const T determinant = m[0] * inverse[0] + m[1] * inverse[1] + m[2] * inverse[2];
    constexpr T kFlat = T(0.01 / 27.0); // the determinant of a sphere is 1/27
    if (determinant > kFlat) {
        const T perDeterminant = T(1) / determinant;
        for (T& x : inverse)
            x *= perDeterminant;
    } else {
        inverse = {T(3), T(0), T(0), T(3), T(0), T(3)};
    }
    std::array<T, 9> g;
    for (size_t k = 0; k < 9; ++k)
        g[k] = flows[k] * scale;
    const auto gradient = [&](size_t a, const T x, const T y, const T z) {
        return g[3 * a] * x + g[3 * a + 1] * y + g[3 * a + 2] * z; // (5)
    };
    const auto& [xx, xy, xz, yy, yz, zz] = inverse;
    const T divergence = gradient(0, xx, xy, xz) + gradient(1, xy, yy, yz) + gradient(2, xz, yz, zz); // (6)
    const T curlX = gradient(2, xy, yy, yz) - gradient(1, xz, yz, zz);
    const T curlY = gradient(0, xz, yz, zz) - gradient(2, xx, xy, xz);
    const T curlZ = gradient(1, xx, xy, xz) - gradient(0, xy, yy, yz);
    return {divergence, std::sqrt(curlX * curlX + curlY * curlY + curlZ * curlZ)};
}

} // namespace fx::sim
