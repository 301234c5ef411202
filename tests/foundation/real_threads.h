/// @file real_threads.h
/// Allows tests with many worker threads on machines with few processors.
#pragma once

#include <tbb/global_control.h>

#include <cstddef>

namespace fx::test {

/// During the lifetime of this object, TBB loops may run on up to `most` threads. Without this object, TBB
/// uses at most as many threads as the machine has processors.
class RealThreads
{
public:
    explicit RealThreads(size_t most) : limit_(tbb::global_control::max_allowed_parallelism, most) {}

private:
    tbb::global_control limit_;
};

} // namespace fx::test
