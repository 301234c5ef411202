/// @file loop_order.h
/// Tells ThreadSanitizer what it cannot see of TBB, which is not built with it: the calls of a loop come
/// after what its caller did before the loop, and before what the caller does after it. Calls of one loop
/// stay unordered among each other, so that their races are found. Nothing at all in other builds.
#pragma once

#if defined(FX_THREAD_SANITIZER)
extern "C" {
void __tsan_acquire(void* address);
void __tsan_release(void* address);
}
#endif

namespace fx::base {

class LoopOrder
{
public:
#if defined(FX_THREAD_SANITIZER)
    LoopOrder()
    {
        __tsan_release(&begin_);
    }
    void enterCall()
    {
        __tsan_acquire(&begin_);
    }
    void leaveCall()
    {
        __tsan_release(&end_);
    }
    void endLoop()
    {
        __tsan_acquire(&end_);
    }

private:
    char begin_ = 0, end_ = 0;
#else
    void enterCall() {}
    void leaveCall() {}
    void endLoop() {}
#endif
};

} // namespace fx::base
