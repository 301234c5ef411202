/// @file clocks.h
/// Three clocks [s]. Each counts from a fixed but arbitrary time, so only differences are meaningful.
///
/// Threads: any.
#pragma once

namespace fx::cli {

double wallSeconds(); ///< [s] steady: not affected by setting the clock of the machine
double
threadSeconds(); ///< [s] of the processor, by the calling thread: other programs and threads do not count
double processSeconds(); ///< [s] processor time of all threads of this process

} // namespace fx::cli
