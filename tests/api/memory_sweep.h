/// @file memory_sweep.h
/// Tests calls with an allocator that fails at the first request, then at the second request, and so on.
#pragma once

#include "fxsdk/fxsdk.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cstdint>
#include <cstdlib>
#include <new>

namespace fx::test {

/// An allocator in which one request fails, or one request and all later requests.
class ScarceMemory
{
public:
    FxAllocator hooks() { return {this, &allocate, &release}; }

    /// Sets the request that fails.
    /// @param n number of the failing request, counted from this call, 1 for the next request; 0: no request
    ///         fails
    /// @param isGone true: all later requests also fail
    void refuse(uint64_t n, bool isGone)
    {
        requests_ = 0;
        refused_ = n;
        isGone_ = isGone;
        hasRefused_ = false;
    }
    bool hasRefused() const { return hasRefused_; }
    int64_t blocks() const { return blocks_; } ///< number of blocks that are allocated and not released

private:
    static void* allocate(void* user, size_t size, size_t alignment)
    {
        auto& self = *static_cast<ScarceMemory*>(user);
        const uint64_t request = ++self.requests_;
        if (self.refused_ > 0 && (request == self.refused_ || (self.isGone_ && request > self.refused_))) {
            self.hasRefused_ = true;
            return nullptr;
        }
        void* const memory = ::operator new(size, std::align_val_t(alignment), std::nothrow);
        self.blocks_ += memory ? 1 : 0;
        return memory;
    }
    static void release(void* user, void* memory, size_t, size_t alignment)
    {
        --static_cast<ScarceMemory*>(user)->blocks_;
        ::operator delete(memory, std::align_val_t(alignment));
    }

    std::atomic<uint64_t> requests_{0};
    std::atomic<int64_t> blocks_{0};
    uint64_t refused_ = 0;
    bool isGone_ = false;
    std::atomic<bool> hasRefused_{false};
};

/// Number of the failing request that follows `n` in a sweep. With the environment variable
/// FXSDK_EVERY_ALLOCATION every request fails in turn. Without the variable, each of the first 32 requests
/// fails in turn. Then the number grows by a sixteenth in each step.
inline uint64_t nextRefused(uint64_t n)
{
    static const bool everyOne = std::getenv("FXSDK_EVERY_ALLOCATION") != nullptr;
    return everyOne ? n + 1 : n + 1 + n / 32 * 2;
}

/// Repeats `action` with a failing request. The number of the failing request increases until `action`
/// succeeds before this request. Each request fails once alone and once together with all later requests. A
/// failing call must return FX_ERROR_OUT_OF_MEMORY, and `isAsBefore` must then return true. A call may also
/// succeed despite the failing request. There must be no leak: the number of blocks must stop growing if the
/// failure at one request is repeated.
/// @return number of failures
template <class Action, class IsAsBefore>
uint64_t refuseEach(ScarceMemory& memory, Action&& action, IsAsBefore&& isAsBefore)
{
    constexpr uint64_t kMax = 100'000;
    uint64_t failures = 0;
    for (uint64_t n = 1; n < kMax; n = nextRefused(n))
        for (const bool isGone : {false, true}) {
            constexpr int kMaxAttempts = 64; // a refused request moves on as room is kept
            int64_t kept = -1;
            for (int attempt = 0; attempt < kMaxAttempts && memory.blocks() != kept; ++attempt) {
                kept = memory.blocks();
                memory.refuse(n, isGone);
                const FxResult result = action();
                const bool hasRefused = memory.hasRefused();
                memory.refuse(0, false);
                if (result == FX_OK && !hasRefused)
                    return failures;
                if (result == FX_OK)
                    break;
                ++failures;
                EXPECT_EQ(result, FX_ERROR_OUT_OF_MEMORY)
                    << "request " << n << ": " << fxGetLastErrorMessage();
                EXPECT_TRUE(isAsBefore()) << "request " << n << (isGone ? " and all after it" : "");
                EXPECT_LT(attempt + 1, kMaxAttempts) << "request " << n << ": each failure keeps memory";
            }
            if (testing::Test::HasFailure())
                return failures;
        }
    ADD_FAILURE() << "it never stops asking for memory";
    return failures;
}

} // namespace fx::test
