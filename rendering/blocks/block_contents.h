/// @file block_contents.h
/// What the blocks of one solver consist of: sums over the balls of each variant, and the balls themselves.
#pragma once

#include "foundation/snapshot/block_groups.h"

#include <glm/vec4.hpp>

#include <memory_resource>
#include <vector>

namespace fx::render {

/// A ball of a block, in the layout of shaders/blocks/block_tiles.comp.glsl.
struct BlockBall
{
    glm::vec4 place;  ///< xyz [m] center relative to the block, in units of the block; w radius [m]
    glm::vec4 medium; ///< rgb albedo; w extinction cross section [m2]
    glm::vec4 light;  ///< rgb emitted light [cd/m2] per optical depth, where the ball is thin
};
static_assert(sizeof(BlockBall) == 48);

/// Sums over the balls of a variant, at all levels. Means are weighted by the cross section.
struct BlockContent
{
    const base::SnapshotGroup* group = nullptr; ///< null: no block in use shows the variant
    float radius = 0.0f;                        ///< [m] of a ball about the origin that holds the content
    float crossSection = 0.0f;                  ///< [m2] sum
    glm::vec3 middle{0.0f};                     ///< [m] mean of the centers, in units of the block
    /// [m] Radius of the ball about `middle` whose kernel has the second moment of the content
    float momentRadius = 0.0f;
    glm::vec3 albedo{0.0f};    ///< mean
    glm::vec3 light{0.0f};     ///< [cd/m2] mean of BlockBall::light
    glm::vec3 brightest{0.0f}; ///< [cd/m2] largest BlockBall::light, by channel
    float fireShare = 0.0f;    ///< mean
    float heat = 0.0f;         ///< [K] mean
    /// [1/m] mean of the cross section of a ball over its radius cubed: the extinction in its middle follows
    /// it
    float peak = 0.0f;
    float speed = 0.0f;      ///< [m/s] largest speed of a ball relative to the block
    bool isAnimated = false; ///< false: the content never changes
    uint32_t balls = 0;      ///< number of balls, at most UINT32_MAX
    bool isColored = false;  ///< true: albedo or emitted light differ between balls
    /// Identifies the content. Static content has the same number in all instances that show it; animated
    /// content has a number of its own for each instance and variant.
    uint64_t identity = 0;
};

class BlockContents
{
public:
    explicit BlockContents(std::pmr::memory_resource* memory) : contents_(memory) {}

    /// Reads the groups of one solver.
    /// @param groups must stay valid until the last call of balls()
    void build(const base::BlockGroups& groups);

    const BlockContent& of(uint32_t variant) const { return contents_[variant]; }
    /// Appends the balls of a variant, at all levels.
    void balls(uint32_t variant, std::pmr::vector<BlockBall>& out) const;

private:
    BlockContent sumOfBalls(const base::SnapshotGroup& group) const;
    BlockContent sumOfBlocks(const base::SnapshotGroup& group) const;
    uint64_t identityOf(const base::SnapshotGroup& group, uint32_t variant,
                        const BlockContent& content) const;

    const base::BlockGroups* groups_ = nullptr;
    std::pmr::vector<BlockContent> contents_; ///< by variant
};

} // namespace fx::render
