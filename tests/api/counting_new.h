/// @file counting_new.h
/// Counts calls of operator new in the whole program, so that tests see allocations that bypass the host's
/// allocator.
#pragma once

#include <cstdint>

namespace fx::test {

/// Number of calls of operator new, in all forms and threads, since the program began.
uint64_t newCalls();
/// As newCalls(), for the calling thread only, because GL drivers have threads of their own.
uint64_t newCallsOfThisThread();

} // namespace fx::test
