/// @file blob_writer.h
/// Fills one "blob" group of a snapshot.
#pragma once

#include "foundation/snapshot/blob_kind.h"
#include "foundation/snapshot/frame_snapshot.h"

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
        : group_(snapshot.addGroup(kind, capacity)), count_(count)
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

    /// Bounds from the positions and radii that have been written.
    void closeBounds()
    {
        namespace blob = base::blob_column;
        const float* radius = column(blob::Radius);
        const float* x = column(blob::PositionX);
        const float* y = column(blob::PositionY);
        const float* z = column(blob::PositionZ);
        base::Bounds bounds;
        for (uint32_t i = 0; i < count_; ++i)
            bounds.add({x[i], y[i], z[i]}, radius[i]);
        group_.editInfo().bounds = bounds;
    }

private:
    base::SnapshotGroup& group_;
    uint32_t count_;
};

} // namespace fx::sim
