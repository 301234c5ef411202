#include "foundation/memory/host_memory.h"

#include <algorithm>
#include <new>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace fx::base {

namespace {

/// Where the runtime puts a block of `size` bytes: whole large pages only fit where they begin.
std::align_val_t alignmentFor(size_t size, size_t alignment)
{
    return std::align_val_t(size >= kLargePage ? std::max(alignment, kLargePage) : alignment);
}

/// Requests large pages for a block, without its last, partial page, which other blocks share. Only speed
/// depends on it.
void askForLargePages([[maybe_unused]] void* memory, [[maybe_unused]] size_t size)
{
#if defined(__linux__) && defined(MADV_HUGEPAGE)
    if (const size_t whole = size / kLargePage * kLargePage; whole > 0)
        (void)::madvise(memory, whole, MADV_HUGEPAGE);
#endif
}

void* allocateFromRuntime(size_t size, size_t alignment)
{
    void* const memory = ::operator new(size, alignmentFor(size, alignment), std::nothrow);
    if (memory)
        askForLargePages(memory, size);
    return memory;
}

} // namespace

void* HostMemory::do_allocate(size_t size, size_t alignment)
{
    void* memory = hooks_.allocate ? hooks_.allocate(hooks_.user, size, alignment)
                                   : allocateFromRuntime(size, alignment);
    if (!memory)
        throw std::bad_alloc();
    count_.fetch_add(1, std::memory_order_relaxed);
    bytes_.fetch_add(size, std::memory_order_relaxed);
    return memory;
}

void HostMemory::do_deallocate(void* memory, size_t size, size_t alignment)
{
    bytes_.fetch_sub(size, std::memory_order_relaxed);
    if (hooks_.release)
        hooks_.release(hooks_.user, memory, size, alignment);
    else
        ::operator delete(memory, alignmentFor(size, alignment));
}

} // namespace fx::base
