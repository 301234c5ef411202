/// @file block_groups.h
/// The groups in which one solver has published its blocks, see block_kind.h, and the placement of what
/// blocks contain.
#pragma once

#include "foundation/snapshot/block_kind.h"
#include "foundation/snapshot/frame_snapshot.h"

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cstdint>

namespace fx::base {

/// Three columns of row `i` as a vector. @param first column of x
inline glm::vec3 vectorAt(const SnapshotGroup& group, size_t first, uint32_t i)
{
    return {group.start(first)[i], group.start(first + 1)[i], group.start(first + 2)[i]};
}

/// The placement, density, age and id that the blocks above an element give to it.
struct BlockFrame
{
    glm::vec3 position{0.0f}; ///< [m]
    glm::vec3 velocity{0.0f}; ///< [m/s]
    glm::quat rotation{1.0f, 0.0f, 0.0f, 0.0f};
    float scale = 1.0f;      ///< [1] of lengths
    float density = 1.0f;    ///< [1] of optical depths
    float age = kSettledAge; ///< [s] the smallest of the blocks
    uint64_t id = 0;         ///< sum of the ids of the blocks

    glm::vec3 turned(const glm::vec3& v) const { return rotation * (scale * v); }
    /// The frame of the content of the block in row `i` of `blocks`.
    BlockFrame inside(const SnapshotGroup& blocks, uint32_t i) const;
};

/// Finds the groups of the blocks of one solver.
class BlockGroups
{
public:
    /// @param end one above the place of the last of the groups; the first one is the blocks of the effect
    BlockGroups(const FrameSnapshot& snapshot, size_t end);

    /// The blocks of the effect.
    const SnapshotGroup& root() const { return snapshot_.added(root_); }
    /// The noise coordinates of the blocks of the effect, row by row: a group of the kind "blockMaterial"
    /// before them; null without.
    const SnapshotGroup* material() const;
    /// True: the group consists of blocks. False: it consists of balls.
    bool isBlocks(const SnapshotGroup& group) const { return group.info().kind == root().info().kind; }
    /// The content of a variant; null if the variant has no ball.
    const SnapshotGroup* content(uint32_t variant) const
    {
        const uint32_t place = places_[variant];
        return place == kAbsent ? nullptr : &snapshot_.added(place);
    }
    /// The content of the block in row `i`; null if it has no ball.
    const SnapshotGroup* contentOf(const SnapshotGroup& blocks, uint32_t i) const
    {
        return content(variantIn(blocks, i));
    }
    static uint32_t variantIn(const SnapshotGroup& blocks, uint32_t i)
    {
        return uint32_t(blocks.start(block_column::Variant)[i]);
    }

private:
    static constexpr uint32_t kAbsent = UINT32_MAX;

    void leaveOutEmpty(size_t end);

    const FrameSnapshot& snapshot_;
    KindId balls_;
    std::array<uint32_t, kMaxBlockVariants> places_; ///< by variant
    size_t root_;
};

} // namespace fx::base
