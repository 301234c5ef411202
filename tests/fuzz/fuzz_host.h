/// @file fuzz_host.h
/// A host of the C API with counted memory, a parallel loop that divides its range, and small presets. The
/// callbacks of the host can call the API.
#pragma once

#include "fxsdk/fxsdk.h"
#include "tests/fuzz/fuzz_target.h"

#include <array>
#include <functional>
#include <map>

namespace fx::fuzz {

/// Presets of low cost that use all solvers: media, sprites, events, trails, fragments, gas and GPU
/// particles.
std::span<const std::string_view> smallPresets();

/// Ends the process if `result` is not a documented code, is FX_ERROR_INTERNAL, or has no message.
FxResult checked(FxResult result);

class FuzzHost
{
public:
    /// Function that each callback of the host calls first; may be empty.
    std::function<void()> intrude;
    /// Function that is called before memory is released.
    std::function<void(const void* memory, size_t size)> releasing;
    bool reversesLoops = false;      ///< true: the parts of a loop run from the last part to the first part
    uint32_t failAfter = UINT32_MAX; ///< number of allocations that succeed; all later allocations fail

    FuzzHost() = default;
    FuzzHost(const FuzzHost&) = delete;
    FuzzHost& operator=(const FuzzHost&) = delete;

    /// A definition with all callbacks of this host except GL. The host must outlive the context.
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

    std::map<void*, std::array<size_t, 2>> blocks_; ///< size and alignment [byte] of each block
    size_t openAssets_ = 0;
};

} // namespace fx::fuzz
