/// @file gl_pass_timer.h
/// Times groups of passes: by timestamps of the GPU, which are read some frames later without waiting, or by
/// a clock of the host, waiting for the GPU after each group.
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
    Gpu,  ///< GL timestamps, without waiting
    Host, ///< a clock of the host, with glFinish() wherever the group changes
};

/// One finished frame.
struct GroupTimes
{
    uint64_t tag = 0;                                  ///< argument of beginFrame()
    std::array<double, kMaxPassGroups> milliseconds{}; ///< by number of PassGroups
    double total() const                               ///< [ms]
    {
        return std::accumulate(milliseconds.begin(), milliseconds.end(), 0.0);
    }
};

/// A clock of the host. [ms] from any origin.
using HostClock = double (*)();
double steadyMilliseconds();

class GlPassTimer
{
public:
    static constexpr size_t kFrames = 6; ///< frames whose results may be pending
    /// Maximum number of timestamps of one frame; further changes of the group are added to the last
    /// timestamp.
    static constexpr size_t kStamps = 12;

    GlPassTimer(GlDevice& device, PassGroups groups) : device_(device), groups_(std::move(groups)) {}
    ~GlPassTimer();
    GlPassTimer(const GlPassTimer&) = delete;
    GlPassTimer& operator=(const GlPassTimer&) = delete;

    const PassGroups& groups() const { return groups_; }

    /// Whether GL measures time: with a counter of 0 bits all times would be 0.
    bool hasGpuClock();

    /// @param tag returned with the result
    void beginFrame(TimingClock clock, uint64_t tag);
    void beginPasses(); ///< the commands of the frame begin
    void beginPass(std::string_view name);
    void endFrame(bool succeeded); ///< a frame that failed gives no result

    /// Takes the times of the oldest finished frame. Does not wait.
    bool take(GroupTimes& out);

    HostClock hostClock = steadyMilliseconds;

private:
    struct Frame
    {
        std::array<uint32_t, kStamps> queries{};
        std::array<size_t, kStamps> groups{}; ///< group of the passes after stamp i
        std::array<double, kStamps> host{};   ///< [ms]
        size_t stamps = 0;
        uint64_t tag = 0;
        TimingClock clock = TimingClock::Off;
    };
    void stamp(size_t next);
    bool isAvailable(const Frame& frame);

    GlDevice& device_;
    PassGroups groups_;
    std::array<Frame, kFrames> frames_;
    size_t first_ = 0;   ///< oldest frame whose result is awaited
    size_t waiting_ = 0; ///< pending frames from there
    Frame* open_ = nullptr;
    size_t group_ = 0;
    int counterBits_ = -1; ///< -1: not queried yet
};

} // namespace fx::render
