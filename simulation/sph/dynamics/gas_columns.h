/// @file gas_columns.h
/// All data of gas particles, as columns in the order of the neighbor tree.
#pragma once

#include "foundation/memory/column.h"
#include "foundation/tasks/task_runner.h"

#include <array>
#include <cstdint>
#include <memory_resource>
#include <span>

namespace fx::sim {

/// All arrays are indexed by slot. During a frame every particle has its own step: velocity and entropy refer
/// to the middle of the step, the position to the tick `drifted`, and all other columns to `begin`. Between
/// frames all columns refer to the same time, and the ticks are 0.
template <class T>
struct GasColumns
{
    GasColumns(std::pmr::memory_resource* memory, uint32_t capacity);

    /// Moves the data of index order[slot] to `slot`, for every column.
    void permute(std::span<const uint32_t> order, base::TaskRunner& tasks);

    /// Calls f(column) for every column that is kept from frame to frame.
    template <class F>
    void forEachLasting(F&& f)
    {
        f(id);
        for (base::Column<T>* column : lasting())
            f(*column);
    }

    base::Column<uint32_t> id;        ///< index with which the particle was added
    base::Column<T> x, y, z;          ///< [m]
    base::Column<T> vx, vy, vz;       ///< [m/s]
    base::Column<T> mass;             ///< [kg]
    base::Column<T> entropy;          ///< K of state-equation
    base::Column<T> ax, ay, az;       ///< [m/s2]
    base::Column<T> entropyRate;      ///< [K/s]
    base::Column<T> support;          ///< [m] 0 before the first density
    base::Column<T> density;          ///< [kg/m3]
    base::Column<T> correction;       ///< [1] f of the density loop
    base::Column<T> divergence;       ///< [1/s]
    base::Column<T> expansion;        ///< [1/s] of the density loop, -drho/dt / rho of the sum
    base::Column<T> divergenceBefore; ///< [1/s] at the evaluation before the last
    base::Column<T> curl;             ///< [1/s]
    base::Column<T> exposure;         ///< [1] of the density loop
    base::Column<T> viscosity;        ///< [1] alpha of the switch
    base::Column<T> limiter;          ///< [1] Balsara
    base::Column<T> pressure, energy; ///< [Pa] [J/kg] energy: the thermal part
    base::Column<T> pressureRate;     ///< [Pa/s]
    base::Column<T> energyRate;       ///< [W/kg]
    base::Column<T> sound;            ///< [m/s]
    base::Column<T> heatToEntropy;    ///< dK per heat
    base::Column<T> wantedStep;       ///< [s] longest step that the particle and its neighborhood allow

    base::Column<uint64_t> begin, end; ///< [tick] of the particle's step
    base::Column<uint64_t> drifted;    ///< [tick] time of the position
    base::Column<uint8_t> level;       ///< binary logarithm of the step in ticks

private:
    std::array<base::Column<T>*, 29> lasting();

    base::Column<T> spare_;
    base::Column<uint64_t> spareTicks_;
    base::Column<uint32_t> spareIds_;
    base::Column<uint8_t> spareLevels_;
};

} // namespace fx::sim
