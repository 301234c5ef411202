/// @file rows_of_a_task.h
/// How many rows of particles are worth another thread.
///
/// To offer a loop to threads that have fallen asleep takes the caller 20 to 40 us, whether they come or not
/// (`bench_parallel_loop` measures it, and with it from how much work on two threads win: 60 to 80 us). A
/// publication moves about 30 bytes a nanosecond and core (`fx bench particles --threads 1`: 44 bytes in
/// 1.4 ns for lean particles, 120 in 4.3 ns for typical ones). So a loop is cut where its parts move at least
/// half of what takes 100 us.
#pragma once

#include "simulation/particles/particle_program.h"

#include <algorithm>

namespace fx::sim {

constexpr size_t kBytesOfATask = size_t(3) << 20; ///< [byte] that one thread had better move alone

/// Rows up to which one thread alone steps or publishes particles of `program`, a multiple of `chunk`.
inline uint32_t rowsOfATask(const ParticleProgram& program, uint32_t chunk)
{
    const uint32_t rows = uint32_t(kBytesOfATask / std::max<size_t>(bytesMoved(program), 1));
    return std::max(rows / chunk, 1u) * chunk;
}

} // namespace fx::sim
