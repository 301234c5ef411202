/// @file masked_snapshots.h
/// The snapshots of a view without the instances that its frame does not show.
#pragma once

#include "foundation/snapshot/filtered_snapshot.h"
#include "fxsdk/scene/scene.h"

#include <array>
#include <cstdint>
#include <memory>
#include <memory_resource>
#include <vector>

namespace fx::api {

/// Threads: [GL thread].
class MaskedSnapshots
{
public:
    explicit MaskedSnapshots(std::pmr::memory_resource* memory)
        : memory_(memory), rules_(memory), hidden_(memory)
    {}

    /// Returns the snapshots without the instances whose mask shares no bit with `mask`. A snapshot that has
    /// none of these instances is not copied. Copies stay valid until the next call, and are reused while
    /// snapshot and masks are the same.
    base::SnapshotPair shown(const base::SnapshotPair& all, const scene::DisplayRules& rules, uint32_t mask);
    /// Forgets the masks and copies of the last scene.
    void forget();

private:
    struct Copy
    {
        std::unique_ptr<base::FrameSnapshot> snapshot;
        uint64_t serial = 0; ///< FrameSnapshot::serial() of the original; 0: none
    };
    const base::FrameSnapshot* shown(const base::FrameSnapshot* all, uint64_t otherSerial);

    std::pmr::memory_resource* memory_;
    std::pmr::vector<scene::InstanceRule> rules_;
    std::pmr::vector<uint64_t> hidden_;    ///< instances that the frame does not show, ascending
    uint64_t revision_ = 0;                ///< of rules_
    uint32_t mask_ = scene::kVisibleToAll; ///< for which hidden_ was listed
    std::array<Copy, 2> copies_;
};

} // namespace fx::api
