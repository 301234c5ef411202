/// @file counting_new.h
/// Counts calls of operator new in the whole program, so that tests see allocations that bypass the host's
/// allocator.
#pragma once

#include <cstdint>

namespace fx::test {

/// Number of calls of all forms of operator new, on all threads, since the start of the program.
uint64_t newCalls();
/// Number of calls of operator new on the calling thread. Other threads are not counted, because GL drivers
/// have threads.
uint64_t newCallsOfThisThread();

} // namespace fx::test
