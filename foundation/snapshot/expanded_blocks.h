/// @file expanded_blocks.h
/// The balls of hierarchies of blocks.
#pragma once

#include "foundation/snapshot/block_kind.h"
#include "foundation/snapshot/frame_snapshot.h"

namespace fx::base {

/// Writes the balls of all blocks of a solver: a LateRows. The groups of the solver's blocks are the added
/// groups immediately before `place`. Balls beyond io.count() are omitted.
///
/// Placements are composed from the effect down to the ball. The id of a ball is the sum of the ids of its
/// blocks and of its own id; so balls are in the order of ids where the ids of blocks leave room for those of
/// their content. Its velocity is that of its block plus its own, turned and scaled; its age is the smallest
/// of theirs.
void expandBlocks(const FrameSnapshot& snapshot, size_t place, SnapshotGroup& io);

/// Writes the noise coordinates of the balls of all blocks of a solver: a LateRows for the group of the kind
/// "material" after that of expandBlocks(). A ball is as far from the coordinates of its block as from the
/// block itself, so that noise moves with blocks.
void expandMaterials(const FrameSnapshot& snapshot, size_t place, SnapshotGroup& io);

/// The function that writes the rows of a late group of a kind: expandBlocks() or expandMaterials().
LateRows lateRowsOf(const KindDesc& kind);

} // namespace fx::base
