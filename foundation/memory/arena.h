/// @file arena.h
/// Scratch memory of one step or one frame: a bump allocator that is reset as a whole.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

namespace fx::base {

/// Allocates from blocks of memory. reset() keeps the blocks. Therefore a frame allocates nothing if it needs
/// no more memory than the previous frame. Destructors are not called: elements must be trivially
/// destructible. Threads: one thread at a time.
class Arena
{
public:
    explicit Arena(std::pmr::memory_resource* upstream, size_t blockSize = size_t(1) << 16);
    ~Arena();
    Arena(const Arena&) = delete;
    Arena& operator=(const Arena&) = delete;

    /// Allocates `count` uninitialised elements, aligned to 64 bytes so that SIMD loads never split a cache
    /// line.
    template <class T>
    std::span<T> allocate(size_t count)
    {
        return {static_cast<T*>(allocateBytes(count * sizeof(T))), count};
    }

    /// Frees all allocations together. If there are several blocks, one block of 1.25 times their total size
    /// replaces them.
    void reset();

private:
    struct Block
    {
        std::byte* memory;
        size_t size;
        size_t used;
    };

    void* allocateBytes(size_t size);
    void addBlock(size_t size);
    void releaseBlocks();

    std::pmr::memory_resource* upstream_;
    size_t blockSize_;
    std::pmr::vector<Block> blocks_;
};

} // namespace fx::base
