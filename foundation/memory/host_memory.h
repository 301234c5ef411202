/// @file host_memory.h
/// A std::pmr memory resource that gets memory from the host's allocator and counts the memory.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory_resource>

namespace fx::base {

/// The host's allocator. If the functions are null, the allocator of the C++ runtime is used. allocate()
/// returns null when memory is exhausted; release() gets the size and alignment that were passed to
/// allocate().
struct AllocatorHooks
{
    void* user = nullptr;
    void* (*allocate)(void* user, size_t size, size_t alignment) = nullptr;
    void (*release)(void* user, void* memory, size_t size, size_t alignment) = nullptr;
};

/// [byte] size of a large page on x86-64.
constexpr size_t kLargePage = size_t(2) << 20;

/// Source of all memory that outlives a call. Without hooks, blocks of at least kLargePage are aligned to
/// kLargePage. On Linux, madvise() requests large pages for these blocks. Large pages reduce TLB misses in
/// loops that read many columns at once. With hooks, the host chooses the pages. Throws std::bad_alloc, which
/// fxsdk/api turns into FX_ERROR_OUT_OF_MEMORY. Thread-safe if the hooks are thread-safe.
class HostMemory final : public std::pmr::memory_resource
{
public:
    explicit HostMemory(const AllocatorHooks& hooks = {}) : hooks_(hooks) {}

    /// Number of allocations since creation.
    uint64_t allocationCount() const { return count_.load(std::memory_order_relaxed); }
    uint64_t bytesInUse() const { return bytes_.load(std::memory_order_relaxed); } ///< [byte]

private:
    void* do_allocate(size_t size, size_t alignment) override;
    void do_deallocate(void* memory, size_t size, size_t alignment) override;
    bool do_is_equal(const memory_resource& other) const noexcept override { return this == &other; }

    AllocatorHooks hooks_;
    std::atomic<uint64_t> count_{0};
    std::atomic<uint64_t> bytes_{0};
};

} // namespace fx::base
