/// @file api_fixture.h
/// A host for the tests of the C API, with an allocator, presets, a context and a scene.
#pragma once

#include "fxsdk/fxsdk.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace fx::test {

/// An allocator that counts blocks and bytes, and that can be set to fail. Several threads may call its
/// callbacks at the same time.
class HostAllocator
{
public:
    FxAllocator hooks() { return {this, &allocate, &release}; }

    /// Makes the `n`th allocation after this call and all later allocations fail; 0: no allocation fails.
    void failFrom(uint64_t n) { remaining_ = n; }
    bool hasFailed() const { return failed_; }
    int64_t blocks() const { return blocks_; } ///< number of blocks that are allocated and not released
    int64_t bytes() const { return bytes_; }   ///< [byte]

private:
    static void* allocate(void* user, size_t size, size_t alignment);
    static void release(void* user, void* memory, size_t size, size_t alignment);

    bool isLeft();

    /// Number of allocations up to and including the first failing allocation; 0: no allocation fails.
    std::atomic<uint64_t> remaining_{0};
    std::atomic<bool> failed_{false};
    std::atomic<int64_t> blocks_{0};
    std::atomic<int64_t> bytes_{0};
};

constexpr double kFrame = 1.0 / 60.0; ///< [s]

/// A preset that emits 60 particles per second without end. The particles live 1 s and fall under gravity.
std::string fountainPreset();
/// A preset of one burst of `count` particles that live `seconds`.
std::string burstPreset(int count, double seconds);

#if FXSDK_WITH_SPH
constexpr bool kHasGas = true;
constexpr const char* kLargeEffect = "library:explosion"; ///< preset of the library that uses most features
#else
constexpr bool kHasGas = false;
constexpr const char* kLargeEffect = "library:burning-debris";
#endif
/// Skips a test of gases if the build has no gases.
#define FX_NEEDS_GAS()                                                                                       \
    if (!fx::test::kHasGas)                                                                                  \
    GTEST_SKIP() << "this build has no gases (FXSDK_WITH_SPH)"

/// A preset of a burst, a fountain, and a gas if the build has gases. It needs little work, but has every
/// kind of state.
std::string smallBlastPreset();

FxPresetId loadText(FxContext* context, const std::string& text);

/// A context without GL on one thread, with a scene and the preset fountainPreset().
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
    uint64_t bytesInUse() const; ///< [byte] memory that the context uses

    FxContext* context_ = nullptr;
    FxScene* scene_ = nullptr;
    FxPresetId fountain_{};
};

} // namespace fx::test
