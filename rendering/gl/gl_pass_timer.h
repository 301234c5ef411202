/// @file gl_pass_timer.h
/// Measures times of groups of passes, with one of two clocks. Timestamps of the GPU are read some frames
/// later without waiting. With a clock of the host, the timer waits for the GPU after each group.
///
/// Threads: [GL thread]. Allocates nothing after construction.
#pragma once

#include "rendering/gl/gl_device.h"
#include "rendering/gl/pass_groups.h"

#include <array>
#include <cstdint>
#include <numeric>
#include <string_view>
#include <utility>

namespace fx::render {

enum class TimingClock : uint8_t
{
    Off,
    Gpu,  ///< uses timestamps of the GPU, without waiting
    Host, ///< uses a clock of the host, with glFinish() wherever the group changes
};

/// Times of one finished frame.
struct GroupTimes
{
    uint64_t tag = 0; ///< argument that was passed to beginFrame()
    /// Times of the groups, indexed by the numbers of PassGroups.
    std::array<double, kMaxPassGroups> milliseconds{};
    double total() const ///< [ms]
    {
        return std::accumulate(milliseconds.begin(), milliseconds.end(), 0.0);
    }
};

/// A function that returns the time of a clock of the host [ms]. The origin of time is arbitrary.
using HostClock = double (*)();
double steadyMilliseconds();

class GlPassTimer
{
public:
    static constexpr size_t kFrames = 6; ///< largest number of frames with pending results
    /// Largest number of timestamps of one frame. If the group changes more often, the remaining passes are
    /// counted in the last group.
    static constexpr size_t kStamps = 12;

    GlPassTimer(GlDevice& device, PassGroups groups) : device_(device), groups_(std::move(groups)) {}
    ~GlPassTimer();
    GlPassTimer(const GlPassTimer&) = delete;
    GlPassTimer& operator=(const GlPassTimer&) = delete;

    const PassGroups& groups() const { return groups_; }

    /// True if OpenGL can measure time, which requires a time counter with more than 0 bits.
    bool hasGpuClock();

    /// Begins a frame. @param tag number that is returned with the times
    void beginFrame(TimingClock clock, uint64_t tag);
    void beginPasses(); ///< Must be called before the first pass of the frame.
    void beginPass(std::string_view name);
    void endFrame(bool succeeded); ///< Ends the frame. A failed frame gives no result.

    /// Moves the times of the oldest finished frame to `out`. Does not wait. @return false if no result is
    /// available
    bool take(GroupTimes& out);

    HostClock hostClock = steadyMilliseconds;

private:
    struct Frame
    {
        std::array<uint32_t, kStamps> queries{};
        std::array<size_t, kStamps> groups{}; ///< for each timestamp: group of the passes after the timestamp
        std::array<double, kStamps> host{};   ///< [ms]
        size_t stamps = 0;
        uint64_t tag = 0;
        TimingClock clock = TimingClock::Off;
    };
    void stamp(size_t next);
    bool isAvailable(const Frame& frame);
    bool read(const Frame& frame, std::array<double, kStamps>& out);

    GlDevice& device_;
    PassGroups groups_;
    std::array<Frame, kFrames> frames_;
    size_t first_ = 0;   ///< index of the oldest frame with a pending result
    size_t waiting_ = 0; ///< number of pending frames
    Frame* open_ = nullptr;
    size_t group_ = 0;
    int counterBits_ = -1; ///< number of bits of GL's time counter; -1: not queried yet
};

} // namespace fx::render
