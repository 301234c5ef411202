/// @file clocks.h
/// Three clocks [s]. Each clock counts from a fixed but arbitrary time, so that only differences are
/// meaningful.
///
/// Threads: any.
#pragma once

namespace fx::cli {

double wallSeconds();    ///< [s] monotonic time, not affected by setting the clock of the machine
double threadSeconds();  ///< [s] processor time of the calling thread
double processSeconds(); ///< [s] processor time of all threads of this process

} // namespace fx::cli
