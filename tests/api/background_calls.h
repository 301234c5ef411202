/// @file background_calls.h
/// Threads that make every call of the C API that any thread may make, while others update and draw.
#pragma once

#include "fxsdk/fxsdk.h"

#include <atomic>
#include <cstdint>
#include <thread>
#include <vector>

namespace fx::test {

/// Threads run until stop() or the end of the object; each is one more for the same scenes and contexts.
class BackgroundCalls
{
public:
    BackgroundCalls() = default;
    ~BackgroundCalls() { stop(); }
    BackgroundCalls(const BackgroundCalls&) = delete;
    BackgroundCalls& operator=(const BackgroundCalls&) = delete;

    /// Acquires one snapshot after another, reads all of them and expects that none changes while it is held.
    void readSnapshots(FxScene* scene);
    /// Loads, asks about and unloads presets with images and meshes, and is refused a broken one.
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
