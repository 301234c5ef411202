/// @file boundary.h
/// Boundary conditions for particles at the sides of the domain.
#pragma once

#include "simulation/sph/neighbors/domain.h"

#include <array>
#include <cmath>
#include <limits>

namespace fx::sim {

/// One axis of a domain, in the precision of the particles.
template <class T>
struct BoundaryAxis
{
    AxisKind kind = AxisKind::Open;
    T low = 0;    ///< [m]
    T high = 0;   ///< [m]
    T length = 0; ///< [m]
};

template <class T>
std::array<BoundaryAxis<T>, 3> boundaryAxes(const Domain& domain)
{
    std::array<BoundaryAxis<T>, 3> axes;
    for (int a = 0; a < 3; ++a)
        axes[size_t(a)] = {domain.axes[size_t(a)], T(domain.low[a]), T(domain.high[a]),
                           T(domain.high[a] - domain.low[a])};
    return axes;
}

/// True if `x` is outside of the domain on this axis.
template <class T>
bool hasLeft(const BoundaryAxis<T>& axis, T x)
{
    if (axis.kind == AxisKind::Open)
        return false;
    return x < axis.low || (axis.kind == AxisKind::Periodic ? x >= axis.high : x > axis.high);
}

/// Moves `x` back into the domain, periodically or by reflection. @return true if the velocity on this axis
/// is reversed
template <class T>
bool bringBack(const BoundaryAxis<T>& axis, T& x)
{
    if (axis.kind == AxisKind::Periodic) {
        x -= axis.length * std::floor((x - axis.low) / axis.length);
        if (!(x >= axis.low && x < axis.high))
            x = axis.low; // the last rounding
        return false;
    }
    bool reversed = false;
    for (int bounce = 0; bounce < 4 && hasLeft(axis, x); ++bounce) {
        x = x < axis.low ? axis.low + (axis.low - x) : axis.high - (x - axis.high);
        reversed = !reversed;
    }
    if (hasLeft(axis, x)) // farther than four lengths of the box in one step
        x = x < axis.low ? axis.low : axis.high;
    return reversed;
}

} // namespace fx::sim
