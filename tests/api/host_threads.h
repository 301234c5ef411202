/// @file host_threads.h
/// Threads of a host for FxContextDef::parallelFor. The code is compiled with the test, so that the thread
/// sanitizer sees all synchronization.
#pragma once

#include "fxsdk/fx_context.h"

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <thread>
#include <vector>

namespace fx::test {

/// Runs parallel loops for any number of simultaneous callers. A caller also processes ranges of its loop.
/// Ranges have the minimum allowed length, and no range waits for another range of its loop.
class HostThreads
{
public:
    explicit HostThreads(uint32_t helpers); ///< @param helpers number of threads besides the callers
    ~HostThreads();
    HostThreads(const HostThreads&) = delete;
    HostThreads& operator=(const HostThreads&) = delete;

    FxParallelFor hook() { return {this, &run}; }
    uint64_t loops() const { return loopCount_; }
    uint64_t rangesOfHelpers() const { return rangesOfHelpers_; }

private:
    struct Loop
    {
        FxLoopBody body;
        void* argument;
        uint64_t count;
        uint64_t batch;
        std::atomic<uint64_t> next{0}; ///< beginning of the next range
        uint32_t helpers = 0;          ///< number of helper threads in the loop; guarded by mutex_
    };
    static void run(void* user, uint32_t count, uint32_t minBatch, FxLoopBody body, void* argument);
    static uint64_t takeRanges(Loop& loop); ///< @return number of processed ranges
    void help();
    Loop* openLoop() const;

    std::mutex mutex_; ///< guards the members from here to threads_
    std::condition_variable changed_;
    std::vector<Loop*> loops_;
    bool isOver_ = false;
    std::vector<std::thread> threads_;
    std::atomic<uint64_t> loopCount_{0};
    std::atomic<uint64_t> rangesOfHelpers_{0};
};

} // namespace fx::test
