/// @file counting_new.h
/// Counts operator new of the whole program, so that tests see allocations that bypass the host's allocator.
#pragma once

#include <cstdint>

namespace fx::test {

/// Calls of every form of operator new since the program began, by any thread.
uint64_t newCalls();
/// The same by the calling thread only: GL drivers have threads of their own.
uint64_t newCallsOfThisThread();

} // namespace fx::test
