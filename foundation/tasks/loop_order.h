/// @file loop_order.h
/// Annotations for ThreadSanitizer, because TBB is not built with ThreadSanitizer. The annotations state that
/// the calls of a parallel loop happen after the caller's code before the loop, and before the caller's code
/// after the loop. Calls of one loop stay unordered, so that races among these calls are found. Without
/// ThreadSanitizer the functions are empty.
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
