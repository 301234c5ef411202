/// @file draw_runs.h
/// In which order blobs and groups of particles take turns, so that they cover each other by distance.
#pragma once

#include "rendering/passes/particle_batch.h"

#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

namespace fx::render {

/// Things that are drawn one after the other in a fixed order.
struct DrawStream
{
    uint32_t batch = MediaRun::kBlobs;
    uint32_t count = 0;
    const float* distances =
        nullptr; ///< [m] of the elements; null: all count as `distance`, and stay together
    const uint32_t* order = nullptr; ///< element drawn as number i, farthest first
    bool isSquared = false;          ///< `distances` holds squares
    float distance = 0.0f;           ///< [m]

    float at(uint32_t i) const;
};

/// Keeps its memory from frame to frame.
class DrawRuns
{
public:
    explicit DrawRuns(std::pmr::memory_resource* memory)
        : byFar_(memory), begin_(memory), parts_(memory), runs_(memory)
    {}

    /// Cuts the streams into runs, farthest first. Streams whose ranges of distance do not overlap stay
    /// whole. Where some do, the overlap is cut into 32 slabs of equal thickness: between slabs the order is
    /// by distance, within one it is stream by stream, the one that is farther in the middle first.
    /// @param streams each of at least one element
    /// @return valid until the next call
    std::span<const MediaRun> build(std::span<const DrawStream> streams);

private:
    struct Part
    {
        uint32_t stream, first, count;
        float middle;
    };
    struct Range
    {
        float near, far; ///< near > far: empty
    };

    Range overlapOf(std::span<const DrawStream> streams);
    void add(const Part& part, uint32_t batch);

    std::pmr::vector<uint32_t> byFar_;
    std::pmr::vector<uint32_t> begin_;
    std::pmr::vector<Part> parts_;
    std::pmr::vector<MediaRun> runs_;
};

} // namespace fx::render
