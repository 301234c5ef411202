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

/// All columns of the gas, indexed by slot. During a frame, every particle has its own step. Velocity and
/// entropy are values at the middle of the step, the position is the value at the tick `drifted`, and all
/// other columns are values at `begin`. Between frames, all columns are values at one time, and the ticks are
/// 0.
template <class T>
struct GasColumns
{
    GasColumns(std::pmr::memory_resource* memory, uint32_t capacity);

    /// Moves the data of index order[slot] to `slot`, for every column.
    void permute(std::span<const uint32_t> order, base::TaskRunner& tasks);

    /// Calls f(column) for every column that is preserved between frames.
    template <class F>
    void forEachLasting(F&& f)
    {
        f(id);
        for (base::Column<T>* column : lasting())
            f(*column);
    }

    base::Column<uint32_t> id;   ///< index with which the particle was added; the id never changes
    base::Column<T> x, y, z;     ///< [m]
    base::Column<T> vx, vy, vz;  ///< [m/s]
    base::Column<T> mass;        ///< [kg]
    base::Column<T> entropy;     ///< entropy function K of formula state-equation
    base::Column<T> ax, ay, az;  ///< [m/s2]
    base::Column<T> entropyRate; ///< [K/s]
    base::Column<T> support;     ///< [m] radius of the kernel's support; 0 before the density is known
    base::Column<T> density;     ///< [kg/m3]
    base::Column<T> correction;  ///< [1] correction f for varying support, see gas-density
    base::Column<T> divergence;  ///< [1/s]
    /// [1/s] Relative rate of decrease of the density, computed by the density loop.
    base::Column<T> expansion;
    base::Column<T> divergenceBefore; ///< [1/s] divergence at the second-last evaluation
    base::Column<T> curl;             ///< [1/s]
    base::Column<T> exposure;         ///< [1] exposure, computed by the density loop
    base::Column<T> viscosity;        ///< [1] coefficient alpha of the artificial viscosity
    base::Column<T> limiter;          ///< [1] Balsara limiter of the viscosity
    base::Column<T> pressure, energy; ///< [Pa] pressure; [J/kg] thermal part of the internal energy
    base::Column<T> pressureRate;     ///< [Pa/s]
    base::Column<T> energyRate;       ///< [W/kg]
    base::Column<T> sound;            ///< [m/s]
    base::Column<T> heatToEntropy;    ///< change of the entropy function K per heat
    base::Column<T> wantedStep;       ///< [s] longest step that the particle and its neighborhood allow

    base::Column<uint64_t> begin, end; ///< [tick] beginning and end of the particle's step
    base::Column<uint64_t> drifted;    ///< [tick] time of the position
    base::Column<uint8_t> level;       ///< binary logarithm of the length of the step in ticks

private:
    std::array<base::Column<T>*, 29> lasting();

    base::Column<T> spare_;
    base::Column<uint64_t> spareTicks_;
    base::Column<uint32_t> spareIds_;
    base::Column<uint8_t> spareLevels_;
};

} // namespace fx::sim
