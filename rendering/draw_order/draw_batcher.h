/// @file draw_batcher.h
/// Divides blobs and groups of particles into batches by depth slabs, so that they cover each other by
/// distance.
#pragma once

#include "rendering/passes/media_source.h"

#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

namespace fx::render {

/// Things that are drawn one after the other in a fixed order.
struct DrawStream
{
    uint32_t batch = 0; ///< number of the source's batch
    uint32_t count = 0;
    const float* distances =
        nullptr; ///< [m] of the elements; null: all count as `distance`, and stay together
    const uint32_t* order = nullptr;     ///< element drawn as number i, farthest first
    bool isSquared = false;              ///< `distances` holds squares
    float distance = 0.0f;               ///< [m]
    bool adds = false;                   ///< the order among streams that only add does not matter
    const MediaSource* source = nullptr; ///< that draws them

    float at(uint32_t i) const;
};

/// Keeps its memory from frame to frame.
class DrawBatcher
{
public:
    explicit DrawBatcher(std::pmr::memory_resource* memory)
        : byFar_(memory), begin_(memory), parts_(memory), batches_(memory)
    {}

    static constexpr uint32_t kMaxBatches = 16;

    /// Cuts the streams into batches, farthest first. Streams are not divided if their ranges of distance do
    /// not overlap or their blending is additive. Where others overlap, that range is divided into slabs of
    /// equal thickness, 32 or as many as kMaxBatches batches allow. Slabs are sorted by distance. Within a
    /// slab, streams are drawn one after the other: first the stream that was drawn last, to avoid a state
    /// change, then by the distance of their centers. Elements in a wrong order are at most one slab
    /// thickness apart: for two streams 1/13 of the range that they share, for three 1/6.
    ///
    /// More than kMaxBatches streams give about one batch each.
    /// @param streams each of at least one element
    /// @return valid until the next call
    std::span<const DrawBatch> build(std::span<const DrawStream> streams);

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
    void cut(std::span<const DrawStream> streams, const Range& overlap, uint32_t slabs);
    void takeParts(std::span<const DrawStream> streams, bool isLast, float edge);
    void arrange(bool goesOn);
    void add(const Part& part, const DrawStream& stream);

    std::pmr::vector<uint32_t> byFar_;
    std::pmr::vector<uint32_t> begin_;
    std::pmr::vector<Part> parts_;
    std::pmr::vector<DrawBatch> batches_;
    uint32_t lastStream_ = 0; ///< of batches_
};

} // namespace fx::render
