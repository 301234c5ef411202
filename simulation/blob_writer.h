/// @file blob_writer.h
/// Fills one "blob" group of a snapshot.
#pragma once

#include "foundation/snapshot/blob_kind.h"
#include "foundation/snapshot/frame_snapshot.h"
#include "foundation/snapshot/streak.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cstdint>

namespace fx::sim {

/// Identity of element `index` of solver `solver`: the same element has the same id in every snapshot.
inline uint64_t blobId(uint32_t solver, uint64_t index)
{
    return (uint64_t(solver) << 40) | (index & ((uint64_t(1) << 40) - 1));
}

/// Names and units a group of `count` blobs; columns are written afterwards, then the bounds are closed.
class BlobWriter
{
public:
    /// @param capacity elements the solver can ever have, so that later snapshots reuse the group's memory
    BlobWriter(base::FrameSnapshot& snapshot, const base::GroupInfo& base, base::KindId kind, uint32_t count,
               uint32_t capacity)
        : group_(snapshot.addGroup(kind, capacity)), count_(count), secondsBack_(snapshot.secondsBack())
    {
        base::GroupInfo& info = group_.editInfo();
        info = base;
        info.kind = kind;
        info.count = count;
    }

    float* column(size_t index) { return group_.editColumn(index).data(); }
    uint64_t* ids() { return group_.editIds().data(); }
    float& constant(size_t index) { return group_.editConstants()[index]; }
    void copy(size_t index, const float* values) { std::copy_n(values, count_, column(index)); }
    void fill(size_t index, float value) { std::fill_n(column(index), count_, value); }

    /// Bounds from what has been written: of the balls, drawn out along their way while the shutter is open,
    /// and at any moment since the snapshot before, where those are who were not in it. Ages do not tell who
    /// that was: they count time of the instance, which may run faster.
    void closeBounds()
    {
        namespace blob = base::blob_column;
        const float* radius = column(blob::Radius);
        const float* age = column(blob::Age);
        const float shutter = constant(base::blob_constant::Shutter);
        base::Bounds bounds;
        for (uint32_t i = 0; i < count_; ++i) {
            const glm::vec3 position = vector(blob::PositionX, i);
            const glm::vec3 velocity = vector(blob::VelocityX, i);
            const float widest = shutter > 0.0f
                                     ? base::streakOf(shutter * glm::length(velocity), radius[i]).radius
                                     : radius[i];
            bounds.add(position, widest);
            const float back = std::min(age[i], kRoundedUp * secondsBack_);
            if (back + shutter > 0.0f)
                bounds.add(position - velocity * (back + shutter), widest);
        }
        group_.editInfo().bounds = bounds;
    }

private:
    static constexpr float kRoundedUp = 1.001f; ///< more than the rounding of times

    glm::vec3 vector(size_t first, uint32_t i)
    {
        return {column(first)[i], column(first + 1)[i], column(first + 2)[i]};
    }

    base::SnapshotGroup& group_;
    uint32_t count_;
    float secondsBack_;
};

} // namespace fx::sim
