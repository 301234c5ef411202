/// @file flight_bound.h
/// Upper bound of the distance that a body flies, for any directions of the forces.
///
/// @formula flight-bound
/// The largest distance from its start that a body reaches, under bounded acceleration and drag towards
/// moving air.
///
/// symbol   unit   meaning
///   T       s      time of flight, >= 0
///   v       m/s    speed at the start, >= 0
///   a       m/s2   bound of the acceleration, >= 0
///   u       m/s    bound of the speed of the air, >= 0
///   k       1/s    drag rate, >= 0
///   s       m      the bound
/// @derivation
///   Without drag |x(T) - x(0)| <= v T + a T^2 / 2, independent of the air                      (1)
///   With dv/dt = a + k (u - v) the speed obeys d|v|/dt <= a + k u - k |v|, hence
///       |v(t)| <= max(v, u + a / k), and |v(t)| <= v + (a + k u) t                             (2)
///   so the path length is at most the smaller of
///       s1 = max(v, u + a / k) T,  s2 = v T + (a + k u) T^2 / 2                                (3)
///   A speed above w = u + a / k approaches w, |v(t)| <= w + (v - w) exp(-k t), hence also
///       s3 = w T + max(v - w, 0) / k                                                           (4)
/// @source    elementary (comparison of differential inequalities)
/// @deviation none
/// @valid     all arguments finite and >= 0
/// @accuracy  an upper bound in exact arithmetic; 1e-6 of it is added for the rounding of the bounded motion
/// @tests     tests/simulation/test_flight_bound.cpp
#pragma once

#include <algorithm>

namespace fx::sim {

struct FlightBound
{
    double seconds = 0;      ///< [s] time of flight T
    double speed = 0;        ///< [m/s] initial speed v
    double acceleration = 0; ///< [m/s2] upper bound a of the acceleration
    double air = 0;          ///< [m/s] upper bound u of the speed of the air
    double drag = 0;         ///< [1/s] drag rate k
};

inline double flightBound(const FlightBound& b)
{
    const double grown = b.acceleration + b.drag * b.air;
    double way = b.speed * b.seconds + 0.5 * grown * b.seconds * b.seconds; // (3) s2, and (1)
    if (b.drag > 0) {
        const double fastest = std::max(b.speed, b.air + b.acceleration / b.drag); // (2)
        way = std::min(way, fastest * b.seconds);                                  // (3) s1
        const double final = b.air + b.acceleration / b.drag;
        way = std::min(way, final * b.seconds + std::max(b.speed - final, 0.0) / b.drag); // (4)
    }
    return way * (1.0 + 1e-6);
}

} // namespace fx::sim
