/// @file task_runner.h
/// Data-parallel loops over TBB, over the host's own job system, or on the calling thread.
#pragma once

#include <cstdint>
#include <memory>
#include <type_traits>

namespace fx::base {

/// A function that executes the iterations [begin, end) of a loop.
using LoopBody = void (*)(void* argument, uint32_t begin, uint32_t end);

/// A parallel loop that the host provides. run() must call `body` with ranges of at least `minBatch` indices
/// that cover every index in [0, count) exactly once; the last range may be shorter. run() must return after
/// all calls of `body` have returned.
struct ParallelForHook
{
    void* user = nullptr;
    void (*run)(void* user, uint32_t count, uint32_t minBatch, LoopBody body, void* argument) = nullptr;
};

/// Runs loops whose iterations do not depend on each other. Results must not depend on the division of the
/// range: a body writes only data of its own indices. Sums are computed after the loop over blocks of fixed
/// size.
class TaskRunner
{
public:
    virtual ~TaskRunner() = default;
    virtual void run(uint32_t count, uint32_t minBatch, LoopBody body, void* argument) = 0;

    /// Calls f(begin, end) for ranges that cover [0, count). Allocates no memory itself.
    template <class F>
    void parallelFor(uint32_t count, uint32_t minBatch, F&& f)
    {
        using Function = std::remove_reference_t<F>;
        run(
            count, minBatch,
            [](void* argument, uint32_t begin, uint32_t end) {
                (*static_cast<Function*>(argument))(begin, end);
            },
            const_cast<std::remove_const_t<Function>*>(&f));
    }
};

std::unique_ptr<TaskRunner> makeSerialRunner();
/// Creates a runner that uses TBB.
/// @param threads upper limit on threads, 0 for as many as the machine has
std::unique_ptr<TaskRunner> makeTbbRunner(uint32_t threads = 0);
std::unique_ptr<TaskRunner> makeHostRunner(const ParallelForHook& hook);

} // namespace fx::base
