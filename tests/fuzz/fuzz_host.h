/// @file fuzz_host.h
/// A host of the C API: counted memory, a parallel loop that cuts its range, and small presets. Its callbacks
/// can call back into the API.
#pragma once

#include "fxsdk/fxsdk.h"
#include "tests/fuzz/fuzz_target.h"

#include <array>
#include <functional>
#include <map>

namespace fx::fuzz {

/// Presets that cost little and cover the solvers: media, sprites, events, trails, fragments, gas, GPU
/// particles.
std::span<const std::string_view> smallPresets();

/// Ends the process if `result` is not a documented code, is FX_ERROR_INTERNAL, or has no message.
FxResult checked(FxResult result);

class FuzzHost
{
public:
    /// Called by each callback of the host before its own work; may be empty.
    std::function<void()> intrude;
    /// Called before memory is released.
    std::function<void(const void* memory, size_t size)> releasing;
    bool reversesLoops = false;      ///< whether the parts of a loop run from the last to the first
    uint32_t failAfter = UINT32_MAX; ///< number of allocations that succeed before all later ones fail

    FuzzHost() = default;
    FuzzHost(const FuzzHost&) = delete;
    FuzzHost& operator=(const FuzzHost&) = delete;

    /// A definition with all hooks of this host except GL. The host must outlive the context.
    FxContextDef contextDef();
    /// number of blocks of memory that have been allocated and not released
    size_t blocks() const { return blocks_.size(); }

private:
    static void* allocate(void* user, size_t size, size_t alignment);
    static void release(void* user, void* memory, size_t size, size_t alignment);
    static void loop(void* user, uint32_t count, uint32_t minBatch, FxLoopBody body, void* argument);
    static void log(void* user, FxLogLevel level, FxResult code, const char* message);
    static const void* open(void* user, const char* name, size_t* outSize);
    static void close(void* user, const void* data, size_t size);
    void callBack() const;

    std::map<void*, std::array<size_t, 2>> blocks_; ///< size and alignment
    size_t openAssets_ = 0;
};

} // namespace fx::fuzz
