/// @file real_threads.h
/// Threads for tests of many workers, also on machines with few processors.
#pragma once

#include <tbb/global_control.h>

#include <cstddef>

namespace fx::test {

/// During its lifetime, TBB loops run on up to `most` threads, as requested. Without it TBB uses at most as
/// many threads as the machine has processors: 16 workers on two processors would be 2 threads.
class RealThreads
{
public:
    explicit RealThreads(size_t most) : limit_(tbb::global_control::max_allowed_parallelism, most) {}

private:
    tbb::global_control limit_;
};

} // namespace fx::test
