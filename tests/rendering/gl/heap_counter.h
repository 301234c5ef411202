/// @file heap_counter.h
/// Counts the heap allocations of this program by operator new. Programs must link
/// tests/api/counting_new.cpp.
#pragma once

#include "tests/api/counting_new.h"

namespace fx::render {

/// Counts allocations by operator new from construction until stop(), in all threads.
class HeapCounter
{
public:
    int stop() const { return int(test::newCalls() - before_); } ///< number of allocations

private:
    uint64_t before_ = test::newCalls();
};

} // namespace fx::render
