/// @file load_monitor.h
/// Progress and cancellation of the load of one document.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <exception>
#include <mutex>
#include <string_view>

namespace fx::asset {

/// Ends a load that was canceled. Owners on the way release what was loaded.
struct LoadCanceled : std::exception
{
    const char* what() const noexcept override { return "the load was canceled"; }
};

/// Threads: one thread loads; any thread may call cancel(), isCanceled() and progress() meanwhile.
class LoadMonitor
{
public:
    static constexpr size_t kItemBytes = 96;

    struct Progress
    {
        float fraction = 0.0f; ///< [1] 0 to 1, never decreases
        uint32_t filesRead = 0;
        std::array<char, kItemBytes> item{}; ///< UTF-8, ends with a zero
    };

    /// Begins a part of the load, which goes from `begin` to `end` of the whole. Throws LoadCanceled.
    void beginPart(std::string_view item, float begin, float end);
    /// Divides the rest of the part into the reading of `count` files.
    void divide(uint32_t count);
    /// States that the file `name` is about to be read. Throws LoadCanceled.
    void beginFile(std::string_view name);
    /// Throws LoadCanceled if the load is canceled.
    void check() const;

    void cancel() { canceled_.store(true, std::memory_order_relaxed); }
    bool isCanceled() const { return canceled_.load(std::memory_order_relaxed); }
    Progress progress() const;

private:
    void show(std::string_view item, float fraction);

    static constexpr float kFileShare = 0.25f; ///< of a part, for one file of an unknown number

    mutable std::mutex mutex_; ///< guards progress_
    Progress progress_;
    std::atomic<bool> canceled_{false};
    float end_ = 1.0f;  ///< of the part
    float step_ = 0.0f; ///< of the next file
};

} // namespace fx::asset
