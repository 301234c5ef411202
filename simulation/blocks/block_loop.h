/// @file block_loop.h
/// The balls of an emitter over one period of a loop, as a table.
#pragma once

#include "foundation/result/status.h"
#include "foundation/snapshot/snapshot_group.h"
#include "foundation/time/ticks.h"

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace fx::sim {

struct EmitterDef;

constexpr uint32_t kMaxLoopFrames = 256;
constexpr size_t kMaxLoopRows = size_t(1) << 19; ///< of all frames

/// An emitter that gives the same births in each period, so that its balls repeat with the period exactly.
/// The balls of the births of one period are recorded from birth to death at equal intervals, the frames of
/// the loop. Between two frames all quantities are linear; balls that are born or die between them appear or
/// fade.
///
/// The balls at a time are a function of this time alone.
class BlockLoop
{
public:
    /// Number of the low bits of an id that tell the period of the birth.
    static constexpr uint32_t kPeriodBits = 4;

    struct Settings
    {
        float period = 4.0f;  ///< [s] > 0
        uint32_t frames = 24; ///< in a period, 1 to kMaxLoopFrames
        uint64_t seed = 1;
        uint64_t maxWork = uint64_t(1) << 25; ///< [particle step] bound of recording: some tenths of a second
        glm::vec3 gravity{0.0f, -9.80665f, 0.0f}; ///< [m/s2]
    };

    /// Runs the emitter, a medium without events, in steps of at most 1/60 s. Its births are those of the
    /// first period.
    /// @return TooLarge for more than kMaxLoopRows rows or Settings::maxWork, InvalidArgument if
    ///         there are no balls or the lifetime is more than 14 periods
    static base::Result<std::shared_ptr<const BlockLoop>> record(const EmitterDef& emitter,
                                                                 const Settings& settings);

    base::Ticks period() const { return frameTicks_ * base::Ticks(frames_.size()); }
    float radius() const { return radius_; }             ///< [m] about the origin; no ball ever leaves it
    float ballRadius() const { return ballRadius_; }     ///< [m] mean over all frames, by cross section
    float crossSection() const { return crossSection_; } ///< [m2] sum over the balls, mean of the frames
    uint64_t span() const { return births_ << kPeriodBits; }
    uint32_t maxBalls() const { return maxBalls_; }
    uint64_t bytes() const;
    uint64_t rowCount() const { return rows_; }
    uint64_t hash() const; ///< of the table

    /// Writes the balls at `time`, at least 0, to a group of the kind "blockBall" with room for maxBalls().
    /// @return their number
    uint32_t write(base::Ticks time, base::SnapshotGroup& io) const;

private:
    static constexpr size_t kValues = 18; ///< columns of the kind "blob"

    struct Row
    {
        uint32_t birth = 0; ///< number of the birth in its period
        uint32_t copy = 0;  ///< number of whole periods since the period of the birth
        std::array<float, kValues> values{};
    };
    using Frame = std::vector<Row>; ///< in the order of ids

    template <class F>
    void merge(const Frame& from, const Frame& to, bool wraps, F&& write) const;
    void measure();

    std::vector<Frame> frames_;
    base::Ticks frameTicks_ = 1;
    uint64_t births_ = 0;
    uint32_t maxBalls_ = 0;
    uint64_t rows_ = 0;
    float radius_ = 0, ballRadius_ = 0, crossSection_ = 0;
};

} // namespace fx::sim
