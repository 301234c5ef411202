/// @file heap_counter.h
/// Counts what this program takes from the heap through operator new.
#pragma once

namespace fx::render {

/// Counts from construction until stop().
class HeapCounter
{
public:
    HeapCounter();
    int stop(); ///< number of allocations
};

} // namespace fx::render
