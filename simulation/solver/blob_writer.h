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

/// Id of element `index` of solver `solver`. An element has the same id in every snapshot.
inline uint64_t blobId(uint32_t solver, uint64_t index)
{
    return (uint64_t(solver) << 40) | (index & ((uint64_t(1) << 40) - 1));
}

/// Creates a group of `count` blobs with its constants. The caller then writes the columns and calls
/// closeBounds().
class BlobWriter
{
public:
    /// Adds a group to the snapshot.
    /// @param capacity maximum number of elements of the solver, so that later snapshots reuse the group's
    ///          memory
    BlobWriter(base::FrameSnapshot& snapshot, const base::GroupInfo& base, base::KindId kind, uint32_t count,
               uint32_t capacity)
        : group_(snapshot.addGroup(kind, capacity)), count_(count), secondsBack_(snapshot.secondsBack())
    {
        base::GroupInfo& info = group_.editInfo();
        info = base;
        info.kind = kind;
        info.count = count;
    }
    /// Continues to write a group that another writer has added.
    BlobWriter(base::SnapshotGroup& group, float secondsBack)
        : group_(group), count_(group.info().count), secondsBack_(secondsBack)
    {}

    uint32_t count() const { return count_; }
    float* column(size_t index) { return group_.editColumn(index).data(); }
    uint64_t* ids() { return group_.editIds().data(); }
    float& constant(size_t index) { return group_.editConstants()[index]; }
    void copy(size_t index, const float* values) { copy(index, values, 0, count_); }
    void fill(size_t index, float value) { fill(index, value, 0, count_); }
    /// Copies the values of a column for the rows [begin, end).
    void copy(size_t index, const float* values, uint32_t begin, uint32_t end)
    {
        std::copy(values + begin, values + end, column(index) + begin);
    }
    void fill(size_t index, float value, uint32_t begin, uint32_t end)
    {
        std::fill(column(index) + begin, column(index) + end, value);
    }

    const base::Bounds& bounds() const { return group_.info().bounds; } ///< computed so far
    void closeBounds() { addBounds(0, count_); }                        ///< computes the bounds of all rows
    /// Extends the bounds by the rows [begin, end), which have been written. The bounds contain the balls,
    /// stretched along their path by the open shutter, at any time since the previous snapshot. Blobs born
    /// since then are included for the whole time. Their age does not show this birth, because the time of
    /// the instance may run faster.
    void addBounds(uint32_t begin, uint32_t end)
    {
        namespace blob = base::blob_column;
        const float* radius = column(blob::Radius);
        const float* age = column(blob::Age);
        const float shutter = constant(base::blob_constant::Shutter);
        base::Bounds bounds = group_.info().bounds;
        for (uint32_t i = begin; i < end; ++i) {
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
    static constexpr float kRoundedUp = 1.001f; ///< factor larger than the rounding errors of times

    glm::vec3 vector(size_t first, uint32_t i)
    {
        return {column(first)[i], column(first + 1)[i], column(first + 2)[i]};
    }

    base::SnapshotGroup& group_;
    uint32_t count_;
    float secondsBack_;
};

} // namespace fx::sim
