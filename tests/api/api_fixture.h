/// @file api_fixture.h
/// A host for the tests of the C API: its memory, its presets, a context and a scene.
#pragma once

#include "fxsdk/fxsdk.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace fx::test {

/// Memory that counts, and that runs out when it is told to. Hooks are called by several threads at once.
class HostAllocator
{
public:
    FxAllocator hooks() { return {this, &allocate, &release}; }

    /// The `n`-th allocation from now, 1 for the next, fails and all after it; 0 for never.
    void failFrom(uint64_t n) { remaining_ = n; }
    bool hasFailed() const { return failed_; }
    int64_t blocks() const { return blocks_; } ///< taken and not given back
    int64_t bytes() const { return bytes_; }   ///< [byte]

private:
    static void* allocate(void* user, size_t size, size_t alignment);
    static void release(void* user, void* memory, size_t size, size_t alignment);

    bool isLeft();

    std::atomic<uint64_t> remaining_{
        0}; ///< allocations until the one that fails, itself included; 0: none fails
    std::atomic<bool> failed_{false};
    std::atomic<int64_t> blocks_{0};
    std::atomic<int64_t> bytes_{0};
};

constexpr double kFrame = 1.0 / 60.0; ///< [s]

/// 60 particles a second that live 1 s, for ever; falls under gravity.
std::string fountainPreset();
/// One burst of `count` particles that live `seconds`.
std::string burstPreset(int count, double seconds);

#if FXSDK_WITH_SPH
constexpr bool kHasGas = true;
constexpr const char* kLargeEffect = "library:explosion"; ///< of the library, with everything that it can do
#else
constexpr bool kHasGas = false;
constexpr const char* kLargeEffect = "library:burning-debris";
#endif
/// In a test about gases; a build without them has nothing to test.
#define FX_NEEDS_GAS()                                                                                       \
    if (!fx::test::kHasGas)                                                                                  \
    GTEST_SKIP() << "this build has no gases (FXSDK_WITH_SPH)"

/// A gas (where there are gases), a burst and a fountain: little work, but everything that has a state.
std::string smallBlastPreset();

FxPresetId loadText(FxContext* context, const std::string& text);

/// A context without GL on one thread, a scene in it, and the fountain.
class ApiTest : public ::testing::Test
{
protected:
    ApiTest();
    ~ApiTest() override;

    FxInstanceDef instanceDef() const;
    FxInstanceId addFountain();
    FxSceneStatistics statistics() const;
    uint64_t hash() const;
    uint64_t simulationHash() const;
    std::vector<std::byte> savedState() const;
    FxResult restore(const std::vector<std::byte>& state) const;
    void play(int frames) const;
    uint64_t bytesInUse() const; ///< [byte] of the context

    FxContext* context_ = nullptr;
    FxScene* scene_ = nullptr;
    FxPresetId fountain_{};
};

} // namespace fx::test
