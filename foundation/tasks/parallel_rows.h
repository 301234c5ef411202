/// @file parallel_rows.h
/// Parallel loops over rows. Each call sets the floating-point mode of the simulation, because worker threads
/// do not inherit this mode.
#pragma once

#include "foundation/simd/floating_point_scope.h"
#include "foundation/tasks/task_runner.h"

#include <cstdint>

namespace fx::base {

/// Calls f(begin, end) for ranges that cover [0, count), each of at least `minBatch` rows.
template <class F>
void parallelRows(TaskRunner& tasks, uint32_t count, uint32_t minBatch, F&& f)
{
    tasks.parallelFor(count, minBatch, [&f](uint32_t begin, uint32_t end) {
        const FloatingPointScope floatingPoint;
        f(begin, end);
    });
}

} // namespace fx::base
