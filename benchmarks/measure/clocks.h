/// @file clocks.h
/// Seconds since a fixed moment, by three clocks. Only differences have a meaning.
///
/// Threads: any.
#pragma once

namespace fx::cli {

double wallSeconds(); ///< [s] steady: setting the clock of the machine does not change it
double
threadSeconds(); ///< [s] of the processor, by the calling thread: other programs and threads do not count
double processSeconds(); ///< [s] of the processor, by all threads of this process

} // namespace fx::cli
