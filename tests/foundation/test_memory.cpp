#include "foundation/memory/amortized_vector.h"
#include "foundation/memory/arena.h"
#include "foundation/memory/column.h"
#include "foundation/memory/host_memory.h"
#include "foundation/memory/same_bytes.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <new>
#include <string>

using namespace fx::base;

namespace {

/// A host allocator that can be told to refuse.
struct CountingHost
{
    int live = 0;
    bool refuses = false;

    AllocatorHooks hooks()
    {
        return {this,
                [](void* user, size_t size, size_t alignment) -> void* {
                    CountingHost& host = *static_cast<CountingHost*>(user);
                    if (host.refuses)
                        return nullptr;
                    ++host.live;
                    return std::aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment);
                },
                [](void* user, void* memory, size_t, size_t) {
                    --static_cast<CountingHost*>(user)->live;
                    std::free(memory);
                }};
    }
};

} // namespace

TEST(HostMemory, usesTheHostsAllocatorAndCounts)
{
    CountingHost host;
    HostMemory memory(host.hooks());
    void* block = memory.allocate(100, 64);
    EXPECT_EQ(host.live, 1);
    EXPECT_EQ(memory.allocationCount(), 1u);
    EXPECT_EQ(memory.bytesInUse(), 100u);
    memory.deallocate(block, 100, 64);
    EXPECT_EQ(host.live, 0);
    EXPECT_EQ(memory.bytesInUse(), 0u);
    EXPECT_EQ(memory.allocationCount(), 1u); // counts allocations, not what is left
}

TEST(HostMemory, aRefusalIsBadAllocAndIsNotCounted)
{
    CountingHost host;
    host.refuses = true;
    HostMemory memory(host.hooks());
    EXPECT_THROW((void)memory.allocate(8, 8), std::bad_alloc);
    EXPECT_EQ(memory.allocationCount(), 0u);
}

TEST(HostMemory, withoutHooksItUsesTheRuntime)
{
    HostMemory memory;
    void* block = memory.allocate(3, 64);
    EXPECT_EQ(reinterpret_cast<uintptr_t>(block) % 64, 0u);
    memory.deallocate(block, 3, 64);
}

TEST(HostMemory, largeBlocksBeginWhereALargePageCan)
{
    HostMemory memory;
    for (const size_t size : {kLargePage, kLargePage + 1, 5 * kLargePage - 7}) {
        auto* block = static_cast<char*>(memory.allocate(size, 64));
        EXPECT_EQ(reinterpret_cast<uintptr_t>(block) % kLargePage, 0u);
        block[0] = block[size - 1] = 1;
        EXPECT_EQ(memory.bytesInUse(), size);
        memory.deallocate(block, size, 64);
    }
    EXPECT_EQ(memory.bytesInUse(), 0u);
}

TEST(HostMemory, aHostIsAskedForWhatIsWantedHoweverLarge)
{
    struct Asked
    {
        size_t size = 0, alignment = 0;
        alignas(64) char block[64];
    } asked;
    HostMemory memory({&asked,
                       [](void* user, size_t size, size_t alignment) -> void* {
                           Asked& host = *static_cast<Asked*>(user);
                           host.size = size;
                           host.alignment = alignment;
                           return host.block;
                       },
                       [](void*, void*, size_t, size_t) {}});
    void* block = memory.allocate(3 * kLargePage, 64);
    EXPECT_EQ(asked.size, 3 * kLargePage);
    EXPECT_EQ(asked.alignment, 64u);
    memory.deallocate(block, 3 * kLargePage, 64);
}

#ifdef __linux__
TEST(HostMemory, linuxIsAskedForLargePagesUnderLargeBlocks)
{
    if (!std::ifstream("/sys/kernel/mm/transparent_hugepage/enabled"))
        GTEST_SKIP() << "this kernel has none";
    HostMemory memory;
    const size_t size = 9 * kLargePage;
    void* block = memory.allocate(size, 64);
    const auto address = reinterpret_cast<uintptr_t>(block);
    std::ifstream maps("/proc/self/smaps");
    bool isInside = false;
    std::string flags;
    for (std::string line; flags.empty() && std::getline(maps, line);) {
        unsigned long begin = 0, end = 0;
        if (std::sscanf(line.c_str(), "%lx-%lx ", &begin, &end) == 2)
            isInside = address >= begin && address < end;
        else if (isInside && line.starts_with("VmFlags:"))
            flags = line + " ";
    }
    EXPECT_NE(flags.find(" hg "), std::string::npos) << flags;
    memory.deallocate(block, size, 64);
}
#endif

TEST(Arena, allocationsAreAlignedAndDoNotOverlap)
{
    HostMemory memory;
    Arena arena(&memory, 256);
    const std::span<float> a = arena.allocate<float>(3);
    const std::span<float> b = arena.allocate<float>(500); // more than a block
    const std::span<float> c = arena.allocate<float>(0);
    EXPECT_EQ(reinterpret_cast<uintptr_t>(a.data()) % 64, 0u);
    EXPECT_EQ(reinterpret_cast<uintptr_t>(b.data()) % 64, 0u);
    EXPECT_TRUE(c.empty());
    std::fill(b.begin(), b.end(), 2.0f);
    std::fill(a.begin(), a.end(), 1.0f);
    EXPECT_EQ(b.front(), 2.0f);
    EXPECT_EQ(b.back(), 2.0f);
}

TEST(Arena, theSameFrameAgainAllocatesNothing)
{
    HostMemory memory;
    Arena arena(&memory, 128);
    const auto frame = [&] {
        for (size_t n = 1; n < 40; ++n)
            (void)arena.allocate<double>(n);
        arena.reset();
    };
    frame();
    frame();
    const uint64_t before = memory.allocationCount();
    for (int i = 0; i < 10; ++i)
        frame();
    EXPECT_EQ(memory.allocationCount(), before);
}

TEST(Arena, returnsEverythingWhenItEnds)
{
    HostMemory memory;
    {
        Arena arena(&memory, 128);
        (void)arena.allocate<char>(1000);
        (void)arena.allocate<char>(1000);
    }
    EXPECT_EQ(memory.bytesInUse(), 0u);
}

TEST(Column, holdsItsCapacityAlignedAndGivesItBack)
{
    HostMemory memory;
    {
        Column<float> column(&memory, 5);
        EXPECT_EQ(column.capacity(), 5u);
        EXPECT_EQ(reinterpret_cast<uintptr_t>(column.data()) % 64, 0u);
        column[4] = 7.0f;
        EXPECT_EQ(column.first(5).back(), 7.0f);
    }
    EXPECT_EQ(memory.bytesInUse(), 0u);
}

TEST(Column, movingLeavesOneOwner)
{
    HostMemory memory;
    {
        Column<int> a(&memory, 4);
        a[0] = 9;
        Column<int> b(std::move(a));
        Column<int> c(&memory, 2);
        c = std::move(b);
        EXPECT_EQ(c[0], 9);
        EXPECT_EQ(c.capacity(), 4u);
    }
    EXPECT_EQ(memory.bytesInUse(), 0u);
}

TEST(Column, ofNothingAllocatesNothing)
{
    HostMemory memory;
    const Column<int> column(&memory, 0);
    EXPECT_EQ(column.data(), nullptr);
    EXPECT_EQ(memory.allocationCount(), 0u);
}

TEST(AmortizedVector, aListThatGrowsByOneAllocatesOnceForEachDoubling)
{
    HostMemory memory;
    std::pmr::vector<int> values(&memory), copies(&memory), room(&memory);
    for (int count = 1; count <= 1024; ++count) {
        assignAmortized(values, size_t(count), count);
        assignAmortized(copies, values);
        reserveAmortized(room, size_t(count));
        EXPECT_EQ(values, std::pmr::vector<int>(size_t(count), count));
        EXPECT_EQ(copies, values);
        EXPECT_TRUE(room.empty());
        EXPECT_GE(room.capacity(), size_t(count));
    }
    EXPECT_EQ(memory.allocationCount(), 3u * 11u) << "1, 2, 4 .. 1024";
    assignAmortized(values, 2, 7);
    EXPECT_EQ(values, (std::pmr::vector<int>{7, 7}));
    EXPECT_EQ(memory.allocationCount(), 3u * 11u);
}

TEST(SameBytes, compareBitsAndNotValues)
{
    const float zero[] = {0.0f}, minus[] = {-0.0f}, two[] = {0.0f, 0.0f};
    const std::span<const float> nothing;
    EXPECT_TRUE(sameBytes<float>(zero, std::span(two).first(1)));
    EXPECT_FALSE(sameBytes<float>(zero, minus));
    EXPECT_FALSE(sameBytes<float>(zero, two));
    EXPECT_FALSE(sameBytes<float>(zero, nothing));
    EXPECT_TRUE(sameBytes<float>(nothing, std::span(two).first(0)));
}
