/// @file domain.h
/// The spatial domain of a gas, with a boundary condition for each axis.
#pragma once

#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <limits>

namespace fx::sim {

enum class AxisKind : uint8_t
{
    Open,      ///< the axis is unbounded
    Periodic,  ///< particles that leave at `high` enter at `low`
    Reflecting ///< rigid, frictionless walls at `low` and `high`; there is no wall at an infinite bound
};

struct Domain
{
    std::array<AxisKind, 3> axes{AxisKind::Open, AxisKind::Open, AxisKind::Open};
    glm::dvec3 low{-std::numeric_limits<double>::infinity()}; ///< [m]
    glm::dvec3 high{std::numeric_limits<double>::infinity()}; ///< [m] > low
};

/// Data of the domain for loops over pairs. Each axis has a period, or walls, or neither.
template <class T>
struct PairImages
{
    /// `period` [m] is the length of a periodic axis, and `perPeriod` [1/m] is 1 / period. Both are 0 on axes
    /// that are not periodic. On all axes, the difference d of two coordinates is corrected to d - period *
    /// round(d * perPeriod).
    std::array<T, 3> period{};
    std::array<T, 3> perPeriod{};
    /// [m] walls of a reflecting axis; infinite where there is no wall. The difference of x_i and the image
    /// of x_j in the wall at w is computed as (x_i - w) + (x_j - w). The result has the same bits if i and j
    /// are exchanged.
    std::array<T, 3> low{-kNone, -kNone, -kNone};
    std::array<T, 3> high{kNone, kNone, kNone};

    /// [m] Position of the wall that is nearer to a particle at `x`. The neighbors of the particle are
    /// mirrored in this wall.
    T nearerWall(uint32_t axis, T x) const
    {
        return x - low[axis] <= high[axis] - x ? low[axis] : high[axis];
    }

private:
    static constexpr T kNone = std::numeric_limits<T>::infinity();
};

template <class T>
PairImages<T> pairImages(const Domain& domain)
{
    PairImages<T> images;
    for (uint32_t a = 0; a < 3; ++a) {
        const double length = domain.high[int(a)] - domain.low[int(a)];
        if (domain.axes[a] == AxisKind::Periodic) {
            images.period[a] = T(length);
            images.perPeriod[a] = T(1) / T(length);
        }
        if (domain.axes[a] == AxisKind::Reflecting) {
            images.low[a] = T(domain.low[int(a)]);
            images.high[a] = T(domain.high[int(a)]);
        }
    }
    return images;
}

} // namespace fx::sim
