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
    Open,      ///< unbounded
    Periodic,  ///< particles that leave at `high` enter at `low`
    Reflecting ///< rigid, frictionless walls at `low` and `high`; there is no wall at an infinite bound
};

struct Domain
{
    std::array<AxisKind, 3> axes{AxisKind::Open, AxisKind::Open, AxisKind::Open};
    glm::dvec3 low{-std::numeric_limits<double>::infinity()}; ///< [m]
    glm::dvec3 high{std::numeric_limits<double>::infinity()}; ///< [m] > low
};

/// Data of the domain for loops over pairs. On each axis there are either a period, or walls, or neither.
template <class T>
struct PairImages
{
    /// [m] period: length of a periodic axis; [1/m] perPeriod: its inverse. Both are 0 on other axes. The
    /// difference d of two coordinates is corrected to d - period * round(d * perPeriod), the same expression
    /// for all axes.
    std::array<T, 3> period{};
    std::array<T, 3> perPeriod{};
    /// [m] walls of a reflecting axis; infinite where there is no wall. The difference of x_i and the image
    /// of x_j in the wall at w is computed as (x_i - w) + (x_j - w). It has the same bits when i and j are
    /// exchanged.
    std::array<T, 3> low{-kNone, -kNone, -kNone};
    std::array<T, 3> high{kNone, kNone, kNone};

    /// [m] Position of the wall nearer to a particle at `x`, in which its neighbors are mirrored.
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
