/// @file moving_cloud.h
/// Balls of medium that are played from numbered lists. What is shown depends on the time alone.
#pragma once

#include "simulation/cloud/ball_list.h"
#include "simulation/solver/sequence_time.h"
#include "simulation/solver/still_medium.h"

#include <memory>
#include <vector>

namespace fx::sim {

constexpr size_t kMaxPlayedBalls = size_t(1) << 22; ///< of all frames together

/// @formula played-balls
/// A ball at a moment between two frames that show it.
///
/// symbol    unit    meaning
///   T       s       time from frame to frame
///   w       1       share of the second frame, 0..1
///   p, v    m, m/s  place and velocity in a frame
///   S       cd/m2   emission
///   r       1/s     rate of ln S in a frame; 0 also: not known
///   a       s       age in a frame
///
/// @derivation
///   The place is the cubic polynomial of Hermite with the places and velocities of both frames:
///       p(w) = (1 + 2w)(1 - w)^2 p1 + w (1 - w)^2 T v1 + w^2 (3 - 2w) p2 - w^2 (1 - w) T v2      (1)
///   Radius, cross section, temperature, albedo and streak are linear in w. Emission is a steep function of
///   the temperature, see volume-advection (6): q = S^(1/16) of a ball that cools evenly is nearly linear in
///   time. It is the cubic polynomial with the rates of both frames, each term T r q / 16 within
///   3 |q2 - q1| + max(q1, q2)/8:
///       q(w) = (1 + 2w)(1 - w)^2 q1 + w (1 - w)^2 T r1 q1/16 + w^2 (3 - 2w) q2 - w^2 (1 - w) T r2 q2/16  (2)
///   and linear if both rates are 0. A ball that only one of the frames shows moves with its velocity; at the
///   time t from the frame it has
///       q = q1 (1 + r1 t/16), with a factor from 0 to 1.4                                       (3)
///   If the second frame shows it with an age below T, it is not there before its birth, at w = 1 - a/T, and
///   whole behind. Otherwise it has the share 1 - w or w of its cross section; snapshots of the steps before
///   and behind have it with the cross section 0.
/// @source    textbook
/// @deviation none
/// @valid     balls of the same number are the same ball
/// @accuracy  (1) is exact for even acceleration; otherwise within T^4/384 of its second derivative
/// @tests     tests/presets/test_clouds.cpp
struct MovingCloudDef final : StillMediumDef
{
    std::vector<std::shared_ptr<const MovingBalls>> frames; ///< at least one
    float framesPerSecond = 24.0f;
    SequenceEnd end = SequenceEnd::Hold;
    uint32_t mostBalls = 0; ///< of three frames in succession

    /// [s] If a ball has a streak: published velocities times this are the streaks, and balls without a
    /// streak have the velocity 0. Otherwise 0, and published velocities are those of the balls.
    float shutter = 0.0f;

    /// Sets `frames`, `mostBalls` and `shutter`.
    void setFrames(std::vector<std::shared_ptr<const MovingBalls>> balls);
    /// A single frame stays also if it is looped.
    SequenceTime time() const
    {
        return {uint32_t(frames.size()), framesPerSecond, frames.size() == 1 ? SequenceEnd::Hold : end};
    }
    /// The balls at a moment. @param frame 0 to below the number of frames, with a fraction
    MovingBalls at(double frame) const;
    /// Most balls that at() returns until the next frame; those that are born until then are included.
    uint32_t countAt(double frame) const;

    std::unique_ptr<Solver> create(const base::SnapshotSchema& schema, const Quality& quality,
                                   std::pmr::memory_resource* memory) const override;
    uint32_t capacity() const override { return mostBalls; }
    bool startsInMotion() const override { return true; }
    bool publishes(const base::KindDesc& kind) const override { return kind == base::kBlobKind; }
    uint64_t bytes() const override;
    float reach(float gravity, float wind, float seconds) const override;

private:
    /// A moment and the steps that end and begin with it, in frames as SequenceTime::Way has them.
    struct Steps
    {
        double before, frame, after;
    };
    /// Calls visit(ball, id) for the balls at a moment, and for those that are shown only at another moment
    /// of its steps, with the cross section 0. The age of those that are born later is below 0. Allocates
    /// nothing.
    template <class Visit>
    void forEachIn(const Steps& steps, const Visit& visit) const;

    /// Of each frame, of each ball: the index of its number among those of all frames, which is the id.
    std::vector<std::vector<uint32_t>> ids_;
    std::vector<uint32_t> counts_; ///< of each frame: balls that it or the next one shows

    friend class MovingCloudSolver;
};

} // namespace fx::sim
