/// @file real_threads.h
/// Threads for tests of many workers, also on machines with few processors.
#pragma once

#include <tbb/global_control.h>

#include <cstddef>

namespace fx::test {

/// While it lives, loops on TBB run on as many threads as they are asked to, up to `most`. Without it on no
/// more than the machine has processors: then 16 workers of two processors would be 2.
class RealThreads
{
public:
    explicit RealThreads(size_t most) : limit_(tbb::global_control::max_allowed_parallelism, most) {}

private:
    tbb::global_control limit_;
};

} // namespace fx::test
