#include "tests/api/measured_new.h"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <malloc.h>
#include <new>

namespace {

// One thread.
size_t largest = 0;
int64_t taken = 0;
int64_t highest = 0;

void* allocate(size_t size, size_t alignment)
{
    void* const memory =
        std::aligned_alloc(alignment, (std::max<size_t>(size, 1) + alignment - 1) / alignment * alignment);
    largest = std::max(largest, size);
    taken += memory ? int64_t(malloc_usable_size(memory)) : 0;
    highest = std::max(highest, taken);
    return memory;
}

void* allocateOrThrow(size_t size, size_t alignment)
{
    if (void* memory = allocate(size, alignment))
        return memory;
    throw std::bad_alloc();
}

void release(void* memory)
{
    taken -= memory ? int64_t(malloc_usable_size(memory)) : 0;
    std::free(memory);
}

constexpr size_t kDefault = alignof(std::max_align_t);

} // namespace

void fx::test::resetMeasuredNew()
{
    largest = 0;
    taken = highest = 0;
}
size_t fx::test::largestNew()
{
    return largest;
}
size_t fx::test::highestNew()
{
    return size_t(highest);
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
    release(memory);
}
void operator delete[](void* memory) noexcept
{
    release(memory);
}
void operator delete(void* memory, size_t) noexcept
{
    release(memory);
}
void operator delete[](void* memory, size_t) noexcept
{
    release(memory);
}
void operator delete(void* memory, std::align_val_t) noexcept
{
    release(memory);
}
void operator delete[](void* memory, std::align_val_t) noexcept
{
    release(memory);
}
void operator delete(void* memory, size_t, std::align_val_t) noexcept
{
    release(memory);
}
void operator delete[](void* memory, size_t, std::align_val_t) noexcept
{
    release(memory);
}
