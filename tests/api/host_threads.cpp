#include "tests/api/host_threads.h"

#include <algorithm>

namespace fx::test {

HostThreads::HostThreads(uint32_t helpers)
{
    for (uint32_t i = 0; i < helpers; ++i)
        threads_.emplace_back([this] { help(); });
}

HostThreads::~HostThreads()
{
    {
        const std::lock_guard lock(mutex_);
        isOver_ = true;
    }
    changed_.notify_all();
    for (std::thread& thread : threads_)
        thread.join();
}

void HostThreads::run(void* user, uint32_t count, uint32_t minBatch, FxLoopBody body, void* argument)
{
    HostThreads& self = *static_cast<HostThreads*>(user);
    Loop loop{body, argument, count, minBatch};
    self.loopCount_.fetch_add(1, std::memory_order_relaxed);
    {
        const std::lock_guard lock(self.mutex_);
        self.loops_.push_back(&loop);
    }
    self.changed_.notify_all();
    takeRanges(loop);
    std::unique_lock lock(self.mutex_);
    std::erase(self.loops_, &loop);
    self.changed_.wait(lock, [&loop] { return loop.helpers == 0; });
}

/// The counter orders nothing: ranges of one loop stay unordered among each other, and their races are found.
uint64_t HostThreads::takeRanges(Loop& loop)
{
    uint64_t taken = 0;
    for (;; ++taken) {
        const uint64_t begin = loop.next.fetch_add(loop.batch, std::memory_order_relaxed);
        if (begin >= loop.count)
            return taken;
        loop.body(loop.argument, uint32_t(begin), uint32_t(std::min(begin + loop.batch, loop.count)));
    }
}

HostThreads::Loop* HostThreads::openLoop() const
{
    const auto found = std::find_if(loops_.begin(), loops_.end(), [](const Loop* loop) {
        return loop->next.load(std::memory_order_relaxed) < loop->count;
    });
    return found == loops_.end() ? nullptr : *found;
}

void HostThreads::help()
{
    std::unique_lock lock(mutex_);
    while (true) {
        changed_.wait(lock, [this] { return isOver_ || openLoop(); });
        Loop* const loop = openLoop();
        if (!loop)
            return; // it is over
        ++loop->helpers;
        lock.unlock();
        rangesOfHelpers_.fetch_add(takeRanges(*loop), std::memory_order_relaxed);
        lock.lock();
        --loop->helpers;
        changed_.notify_all();
    }
}

} // namespace fx::test
