#include "foundation/tasks/task_runner.h"

#include "foundation/tasks/loop_order.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>

namespace fx::base {

namespace {

class SerialRunner final : public TaskRunner
{
public:
    void run(uint32_t count, uint32_t, LoopBody body, void* argument) override
    {
        if (count > 0)
            body(argument, 0, count);
    }
};

class TbbRunner final : public TaskRunner
{
public:
    explicit TbbRunner(uint32_t threads) : arena_(threads == 0 ? tbb::task_arena::automatic : int(threads)) {}

    void run(uint32_t count, uint32_t minBatch, LoopBody body, void* argument) override
    {
        const uint32_t batch = std::max(minBatch, 1u);
        if (count <= batch) { // waking other threads costs more than this is worth
            if (count > 0)
                body(argument, 0, count);
            return;
        }
        LoopOrder order;
        arena_.execute([&] {
            tbb::parallel_for(tbb::blocked_range<uint32_t>(0, count, batch),
                              [&](const tbb::blocked_range<uint32_t>& r) {
                                  order.enterCall();
                                  body(argument, r.begin(), r.end());
                                  order.leaveCall();
                              });
        });
        order.endLoop();
    }

private:
    tbb::task_arena arena_;
};

class HostRunner final : public TaskRunner
{
public:
    explicit HostRunner(const ParallelForHook& hook) : hook_(hook) {}

    void run(uint32_t count, uint32_t minBatch, LoopBody body, void* argument) override
    {
        if (count > 0)
            hook_.run(hook_.user, count, std::max(minBatch, 1u), body, argument);
    }

private:
    ParallelForHook hook_;
};

} // namespace

std::unique_ptr<TaskRunner> makeSerialRunner()
{
    return std::make_unique<SerialRunner>();
}
std::unique_ptr<TaskRunner> makeTbbRunner(uint32_t threads)
{
    return std::make_unique<TbbRunner>(threads);
}
std::unique_ptr<TaskRunner> makeHostRunner(const ParallelForHook& hook)
{
    return std::make_unique<HostRunner>(hook);
}

} // namespace fx::base
