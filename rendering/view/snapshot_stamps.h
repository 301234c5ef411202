/// @file snapshot_stamps.h
/// Numbers that tell whether two snapshots hold the same, so that what was made of one need not be made
/// again.
///
/// Threads: one thread at a time. Allocates nothing.
#pragma once

#include "foundation/snapshot/snapshot_ring.h"

#include <array>
#include <cstdint>

namespace fx::render {

/// Whether every group, id, column, constant and placement is the same, bit for bit. Ends at the first
/// difference: comparing snapshots of something that moves costs next to nothing.
bool holdSame(const base::FrameSnapshot& a, const base::FrameSnapshot& b);

/// Stamps of the two snapshots of a frame; 0 stands for no snapshot.
struct StampPair
{
    uint64_t newer = 0;
    uint64_t older = 0;

    bool operator==(const StampPair&) const = default;
    bool isSteady() const { return newer == older; } ///< any moment between the two looks the same
};

/// Gives every content its own stamp. A snapshot is compared with its predecessor once; scenes in which
/// nothing moves keep their stamp however often they publish.
class SnapshotStamps
{
public:
    StampPair stampsOf(const base::SnapshotPair& snapshots);

private:
    /// Names a snapshot: those of one ring differ in their number, those of two in their address.
    struct Known
    {
        const base::FrameSnapshot* snapshot = nullptr; ///< never followed; null: none
        uint64_t sequence = 0;
        base::Ticks tick = 0;
        uint64_t stamp = 0;
    };
    uint64_t find(const base::FrameSnapshot& snapshot) const; ///< 0: not known
    void remember(const base::FrameSnapshot& snapshot, uint64_t stamp);

    std::array<Known, 4> known_{};
    size_t next_ = 0; ///< of known_, to be overwritten
    uint64_t last_ = 0;
};

} // namespace fx::render
