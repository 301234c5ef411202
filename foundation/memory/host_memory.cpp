#include "foundation/memory/host_memory.h"

#include <new>

namespace fx::base {

void* HostMemory::do_allocate(size_t size, size_t alignment)
{
    void* memory = hooks_.allocate ? hooks_.allocate(hooks_.user, size, alignment)
                                   : ::operator new(size, std::align_val_t(alignment), std::nothrow);
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
        ::operator delete(memory, std::align_val_t(alignment));
}

} // namespace fx::base
