/// @file filtered_snapshot.h
/// Copies of snapshots with some of their groups.
#pragma once

#include "foundation/snapshot/frame_snapshot.h"

#include <cstdint>
#include <span>

namespace fx::base {

/// True if `snapshot` has a group of one of `instances`.
/// @param instances ascending
bool hasGroupOf(const FrameSnapshot& snapshot, std::span<const uint64_t> instances);

/// Replaces the content of `out` by the groups of `snapshot` that are not of `left`, in the same order.
/// Pooled groups become groups with rows of their own; rows of late groups are still computed when they are
/// read.
/// @param left ids of instances, ascending
/// @param out has the schema of `snapshot`; its memory is reused
void copyWithout(const FrameSnapshot& snapshot, std::span<const uint64_t> left, FrameSnapshot& out);

/// Replaces the content of `out` by some groups of `snapshot`, in the order of `groups`, likewise.
/// @param groups indices of groups
void copyGroups(const FrameSnapshot& snapshot, std::span<const uint32_t> groups, FrameSnapshot& out);

} // namespace fx::base
