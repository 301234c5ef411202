#include "heap_counter.h"

#include <atomic>
#include <cstdlib>
#include <new>

namespace {

std::atomic<int> allocations{0};
std::atomic<bool> isCounting{false};

void* take(size_t size, size_t alignment)
{
    if (isCounting)
        ++allocations;
    const size_t rounded = (size + alignment - 1) / alignment * alignment;
    if (void* memory = std::aligned_alloc(alignment, rounded ? rounded : alignment))
        return memory;
    throw std::bad_alloc();
}

constexpr size_t kDefault = __STDCPP_DEFAULT_NEW_ALIGNMENT__;

} // namespace

// All forms, so that sanitizers never see one form's memory released by another's.
// clang-format off
void* operator new(size_t size) { return take(size, kDefault); }
void* operator new[](size_t size) { return take(size, kDefault); }
void* operator new(size_t size, const std::nothrow_t&) noexcept { return take(size, kDefault); }
void* operator new[](size_t size, const std::nothrow_t&) noexcept { return take(size, kDefault); }
void* operator new(size_t size, std::align_val_t alignment) { return take(size, static_cast<size_t>(alignment)); }
void* operator new[](size_t size, std::align_val_t alignment) { return take(size, static_cast<size_t>(alignment)); }
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete[](void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, size_t) noexcept { std::free(memory); }
void operator delete[](void* memory, size_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::align_val_t) noexcept { std::free(memory); }
void operator delete(void* memory, size_t, std::align_val_t) noexcept { std::free(memory); }
void operator delete[](void* memory, size_t, std::align_val_t) noexcept { std::free(memory); }
// clang-format on

namespace fx::render {

HeapCounter::HeapCounter()
{
    allocations = 0;
    isCounting = true;
}

int HeapCounter::stop()
{
    isCounting = false;
    return allocations;
}

} // namespace fx::render
