/// @file floating_point_scope.h
/// Sets the floating-point mode of the simulation, and restores the host's mode afterwards.
#pragma once

#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

namespace fx::base {

/// During the lifetime of this object the thread rounds to nearest, flushes denormals to zero and masks
/// floating-point exceptions. The destructor restores the host's mode. Values of a cooling gas become
/// denormal. On current processors, operations on denormal values take up to ninety times as long.
class FloatingPointScope
{
public:
#if defined(__SSE2__)
    FloatingPointScope() : saved_(_mm_getcsr())
    {
        _mm_setcsr(kMaskAll | kFlushToZero | kDenormalsAreZero);
    }
    ~FloatingPointScope()
    {
        _mm_setcsr(saved_);
    }
#else
    FloatingPointScope() = default;
    ~FloatingPointScope() {} // other processors keep denormals, which is slower
#endif
    FloatingPointScope(const FloatingPointScope&) = delete;
    FloatingPointScope& operator=(const FloatingPointScope&) = delete;

private:
#if defined(__SSE2__)
    static constexpr unsigned kMaskAll = 0x1F80;
    static constexpr unsigned kFlushToZero = 0x8000;
    static constexpr unsigned kDenormalsAreZero = 0x0040;
    unsigned saved_;
#endif
};

} // namespace fx::base
