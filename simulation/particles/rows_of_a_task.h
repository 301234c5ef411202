/// @file rows_of_a_task.h
/// Number of rows of particles above which a second thread is worthwhile.
///
/// Offering a loop to sleeping threads takes the caller 10 to 40 us (`fx bench parallel-loop`). The operating
/// system decides when the threads wake. A second thread that is awake is worthwhile for at least 50 to 70 us
/// of work. A virtual machine with two cores wakes a thread on the caller's core and moves it to the second
/// core much later. On this machine, a second thread was worthwhile for at least 2 ms of work after pauses of
/// 1 ms, and for at least 6 ms after pauses of 4 ms. A loop is divided if its parts take at least 50 us.
/// Threads that wake in time halve the time of the loop. Threads that wake too late increase the time by a
/// fifth (`fx bench parallel-loop`). A publication moves about 30 bytes per nanosecond and core (`fx bench
/// particles
/// --threads 1`).
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
