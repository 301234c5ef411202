/// @file background_calls.h
/// Threads that call all functions that the C API allows on any thread, while other threads update and draw.
#pragma once

#include "fxsdk/fxsdk.h"

#include <atomic>
#include <cstdint>
#include <thread>
#include <vector>

namespace fx::test {

/// Calls functions on separate threads. Each member function starts a thread, which runs until stop() or the
/// destruction of this object.
class BackgroundCalls
{
public:
    BackgroundCalls() = default;
    ~BackgroundCalls() { stop(); }
    BackgroundCalls(const BackgroundCalls&) = delete;
    BackgroundCalls& operator=(const BackgroundCalls&) = delete;

    /// Acquires snapshots repeatedly and reads them completely. Expects that a snapshot does not change
    /// before its release.
    void readSnapshots(FxScene* scene);
    /// Loads, queries and unloads presets with images and meshes, and expects an error for a broken preset.
    void loadPresets(FxContext* context);
    void readMemoryStatistics(FxContext* context);
    void stop();

    uint64_t snapshots() const { return snapshots_; }
    uint64_t loads() const { return loads_; }
    uint64_t memoryReadings() const { return memoryReadings_; }

private:
    template <class F>
    void repeat(std::atomic<uint64_t>& count, F&& call);

    std::atomic<bool> isOver_{false};
    std::atomic<uint64_t> snapshots_{0};
    std::atomic<uint64_t> loads_{0};
    std::atomic<uint64_t> memoryReadings_{0};
    std::vector<std::thread> threads_;
};

} // namespace fx::test
