/// @file tile_motion.h
/// Integration of a tile, compiled for each instruction set.
///
/// @formula tile-motion
/// One step of a row under the sums of acceleration, air velocity, linear and quadratic drag.
///
/// symbol    unit   meaning
///   v, x           velocity and position
///   u         m/s  velocity of the air
///   a         m/s2 acceleration
///   k         1/s  linear drag rate
///   q         1/m  quadratic drag
///   t         s    the row's part of the step
///   E, G, R        as in linear-drag-step
/// @derivation
///   Quadratic drag alone, dw/dt = -q |w| w with w = v - u, has the solution
///       w(t) = w / (1 + q |w| t)                                                            (1)
///   It acts for half of the time before and for half of it after a step of linear-drag-step:
///       v = u + w / (1 + q |w| t / 2)                                                       (2)
///       x = x + G v + k R u + R a,  v = E v + k G u + G a                                   (3)
///   and (2) again. Two half steps of (1) equal a whole one, so the velocity is exact if nothing else acts.
/// @source    elementary; the splitting is Strang's
/// @deviation none
/// @valid     any t >= 0, k >= 0, q >= 0; no step length makes it unstable, because (1) and E only shrink
/// @accuracy  (3) as drag-coefficients; the position under quadratic drag is of second order in t
/// @tests     tests/simulation/particles/core/test_tile_motion.cpp
#pragma once

#include "simulation/particles/tile.h"

namespace fx::sim {

/// Inputs of fillTimes(): times of the rows of a tile.
struct TileTimes
{
    const base::Ticks* born; ///< birth ticks of the rows of the tile
    const float* perLife;    ///< [1/s] reciprocal lifetimes of the rows; null if equal for all particles
    float perLifeOfAll;
    base::Ticks begin;
    base::Ticks end;
};

/// Computes age, seconds and life of each row. Sets the flag Empty for rows outside of [firstLiving,
/// endLiving) and for particles past their lifetime.
void fillTimes(const TileTimes& times, Tile& tile);

/// Moves every row by its seconds. Rows with the flag Stuck or Empty do not move.
void integrate(Tile& tile);

} // namespace fx::sim
