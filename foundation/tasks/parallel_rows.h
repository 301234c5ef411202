/// @file parallel_rows.h
/// Loops over rows in the floating-point mode of the simulation, which worker threads do not inherit.
#pragma once

#include "foundation/simd/floating_point_scope.h"
#include "foundation/tasks/task_runner.h"

#include <cstdint>

namespace fx::base {

/// Calls f(begin, end) over [0, count) in batches of at least `minBatch`.
template <class F>
void parallelRows(TaskRunner& tasks, uint32_t count, uint32_t minBatch, F&& f)
{
    tasks.parallelFor(count, minBatch, [&f](uint32_t begin, uint32_t end) {
        const FloatingPointScope floatingPoint;
        f(begin, end);
    });
}

} // namespace fx::base
