/// @file rows_of_a_task.h
/// Number of rows of particles above which a second thread is worthwhile.
///
/// Offering a loop to sleeping threads takes the caller 10 to 40 us, whether or not they wake in time
/// (`fx bench parallel-loop`). The operating system decides when they wake. Awake threads are worthwhile from
/// 50 to 70 us of work on. A virtual machine with two cores wakes a thread on the caller's core and moves it
/// to the other core much later: there a second thread was worthwhile from 2 ms on after pauses of 1 ms, and
/// from 6 ms on after pauses of 4 ms. No single limit suits both cases. A loop is divided if its parts take
/// at least 50 us. Threads that wake in time halve its time; threads that do not make it slower by a fifth
/// (the same benchmark). A publication moves about 30 bytes per nanosecond and core
/// (`fx bench particles --threads 1`: 44 bytes in 1.4 ns for lean particles, 120 in 4.3 ns for typical ones).
#pragma once

#include "simulation/particles/particle_program.h"

#include <algorithm>

namespace fx::sim {

constexpr size_t kBytesOfATask = size_t(3) << 20; ///< [byte] amount of data below which one thread is faster

/// Number of rows up to which a single thread steps or publishes particles of `program`; a multiple of
/// `chunk`.
inline uint32_t rowsOfATask(const ParticleProgram& program, uint32_t chunk)
{
    const uint32_t rows = uint32_t(kBytesOfATask / std::max<size_t>(bytesMoved(program), 1));
    return std::max(rows / chunk, 1u) * chunk;
}

} // namespace fx::sim
