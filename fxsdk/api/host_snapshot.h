/// @file host_snapshot.h
/// Copies of snapshots in the units and axes of the host's world.
#pragma once

#include "foundation/snapshot/frame_snapshot.h"
#include "fxsdk/api/host_world.h"

#include <memory>
#include <memory_resource>

namespace fx::api {

/// What a column or constant is, by its name and unit and those of its neighbors.
enum class Meaning : uint8_t
{
    Number,     ///< does not depend on units of length and axes
    Length,     ///< [m]
    Area,       ///< [m2]
    Vector,     ///< x of a position, displacement or velocity; y and z follow
    Direction,  ///< x of a direction; y and z follow
    Quaternion, ///< x of a rotation; y, z and w follow
};

/// @param descs columns or constants of a kind @param index of which the meaning is returned
Meaning meaningOf(std::span<const base::ColumnDesc> descs, size_t index);

/// A copy of a snapshot without particles that the GPU computes. Callable from any thread.
std::unique_ptr<base::FrameSnapshot> toHostWorld(const HostWorld& world, const base::FrameSnapshot& snapshot,
                                                 std::pmr::memory_resource* memory);

} // namespace fx::api
