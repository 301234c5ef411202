/// @file draw_batcher.h
/// Divides blobs and groups of particles into batches by depth slabs, so that nearer elements are drawn over
/// farther elements.
#pragma once

#include "rendering/passes/media_source.h"

#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

namespace fx::render {

/// Elements of one source that are drawn one after another in a fixed order.
struct DrawStream
{
    uint32_t batch = 0; ///< index of the stream's batch in its source
    uint32_t count = 0;
    /// [m] Distances of the elements. Null: all elements have the distance `distance`, and the stream is not
    /// divided.
    const float* distances = nullptr;
    const uint32_t* order = nullptr;     ///< indices of the elements in the order of drawing, farthest first
    bool isSquared = false;              ///< true: `distances` are squares of distances
    float distance = 0.0f;               ///< [m]
    bool adds = false;                   ///< true: the elements are blended additively
    const MediaSource* source = nullptr; ///< source that draws the elements

    float at(uint32_t i) const;
};

/// Builds the batches of a frame. The memory is kept from frame to frame.
class DrawBatcher
{
public:
    explicit DrawBatcher(std::pmr::memory_resource* memory)
        : byFar_(memory), begin_(memory), parts_(memory), batches_(memory)
    {}

    static constexpr uint32_t kMaxBatches = 16;

    /// Divides the streams into batches, sorted by decreasing distance. The range of distances in which
    /// streams overlap is divided into slabs of equal thickness. An overlap of streams with additive
    /// blending does not count. There are 32 slabs, or fewer if the number of batches would exceed
    /// kMaxBatches. Within a slab, streams are drawn one after the other. The first stream is the last
    /// stream of the previous slab, to avoid a state change. The other streams follow by decreasing
    /// distance. Elements in a wrong order are at most one slab thickness apart.
    ///
    /// If there are more than kMaxBatches streams, each stream gives about one batch.
    /// @param streams streams with at least one element each
    /// @return batches, valid until the next call
    std::span<const DrawBatch> build(std::span<const DrawStream> streams);

private:
    struct Part
    {
        uint32_t stream, first, count;
        float middle;
    };
    struct Range
    {
        float near, far; ///< empty if near > far
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
    uint32_t lastStream_ = 0; ///< index of the stream of the last batch in batches_
};

} // namespace fx::render
