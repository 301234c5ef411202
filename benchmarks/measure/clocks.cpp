#include "benchmarks/measure/clocks.h"

#include <ctime>

namespace fx::cli {
namespace {

double secondsOf(clockid_t clock)
{
    timespec now{};
    clock_gettime(clock, &now);
    return double(now.tv_sec) + 1e-9 * double(now.tv_nsec);
}

} // namespace

double wallSeconds()
{
    return secondsOf(CLOCK_MONOTONIC);
}

double threadSeconds()
{
    return secondsOf(CLOCK_THREAD_CPUTIME_ID);
}

double processSeconds()
{
    return secondsOf(CLOCK_PROCESS_CPUTIME_ID);
}

} // namespace fx::cli
