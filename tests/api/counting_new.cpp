#include "tests/api/counting_new.h"

#include <atomic>
#include <cstddef>
#include <cstdlib>
#include <new>

namespace {

std::atomic<uint64_t> calls{0};
thread_local uint64_t callsOfThisThread = 0;

void* allocate(size_t size, size_t alignment)
{
    calls.fetch_add(1, std::memory_order_relaxed);
    ++callsOfThisThread;
    return std::aligned_alloc(alignment,
                              (size + alignment - 1) / alignment * alignment + (size == 0 ? alignment : 0));
}

void* allocateOrThrow(size_t size, size_t alignment)
{
    if (void* memory = allocate(size, alignment))
        return memory;
    throw std::bad_alloc();
}

constexpr size_t kDefault = alignof(std::max_align_t);

} // namespace

uint64_t fx::test::newCalls()
{
    return calls.load(std::memory_order_relaxed);
}
uint64_t fx::test::newCallsOfThisThread()
{
    return callsOfThisThread;
}

// All forms, so that sanitizers never see one form's memory released by another's.
void* operator new(size_t size)
{
    return allocateOrThrow(size, kDefault);
}
void* operator new[](size_t size)
{
    return allocateOrThrow(size, kDefault);
}
void* operator new(size_t size, std::align_val_t alignment)
{
    return allocateOrThrow(size, size_t(alignment));
}
void* operator new[](size_t size, std::align_val_t alignment)
{
    return allocateOrThrow(size, size_t(alignment));
}
void* operator new(size_t size, const std::nothrow_t&) noexcept
{
    return allocate(size, kDefault);
}
void* operator new[](size_t size, const std::nothrow_t&) noexcept
{
    return allocate(size, kDefault);
}
void* operator new(size_t size, std::align_val_t alignment, const std::nothrow_t&) noexcept
{
    return allocate(size, size_t(alignment));
}
void* operator new[](size_t size, std::align_val_t alignment, const std::nothrow_t&) noexcept
{
    return allocate(size, size_t(alignment));
}
void operator delete(void* memory) noexcept
{
    std::free(memory);
}
void operator delete[](void* memory) noexcept
{
    std::free(memory);
}
void operator delete(void* memory, size_t) noexcept
{
    std::free(memory);
}
void operator delete[](void* memory, size_t) noexcept
{
    std::free(memory);
}
void operator delete(void* memory, std::align_val_t) noexcept
{
    std::free(memory);
}
void operator delete[](void* memory, std::align_val_t) noexcept
{
    std::free(memory);
}
void operator delete(void* memory, size_t, std::align_val_t) noexcept
{
    std::free(memory);
}
void operator delete[](void* memory, size_t, std::align_val_t) noexcept
{
    std::free(memory);
}
