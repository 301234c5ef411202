#include "tests/simulation/fragments/fragment_burst.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <new>

namespace {
std::atomic<long> allocations{0};

void* counted(std::size_t size, std::size_t alignment)
{
    ++allocations;
    void* memory = std::aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment);
    if (!memory)
        throw std::bad_alloc();
    return memory;
}
} // namespace

void* operator new(std::size_t size)
{
    return counted(size ? size : 1, alignof(std::max_align_t));
}
void* operator new(std::size_t size, std::align_val_t alignment)
{
    return counted(size, std::size_t(alignment));
}
void* operator new(std::size_t size, std::align_val_t alignment, const std::nothrow_t&) noexcept
{
    return counted(size, std::size_t(alignment));
}
void operator delete(void* memory) noexcept
{
    std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept
{
    std::free(memory);
}
void operator delete(void* memory, std::align_val_t) noexcept
{
    std::free(memory);
}
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept
{
    std::free(memory);
}

using namespace fx;
using namespace fx::test;

TEST(FragmentsAllocations, stepAndPublishMakeNoneAfterTheFirst)
{
    Stage stage;
    stage.add({}, grounded(burst(60)));
    stage.play(1); // scratch memory takes its size
    stage.look();
    const long before = allocations.load();
    const uint64_t hostBefore = stage.memory().allocationCount();
    for (int i = 0; i < 90; ++i) {
        stage.step();
        stage.look();
    }
    EXPECT_GT(stage.counters().born, 500u);
    EXPECT_EQ(allocations.load() - before, 0);
    EXPECT_EQ(stage.memory().allocationCount() - hostBefore, 0u);
}

TEST(FragmentsAllocations, theCounterCounts)
{
    const long before = allocations.load();
    ::operator delete(::operator new(4)); // a direct call, which no compiler may leave out
    EXPECT_EQ(allocations.load() - before, 1);
}
