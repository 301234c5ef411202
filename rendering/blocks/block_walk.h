/// @file block_walk.h
/// Decides which blocks are drawn as impostors and which ones as what they consist of.
#pragma once

#include "rendering/blocks/block_errors.h"
#include "rendering/field_detail/blob_detail.h"
#include "rendering/frame/view_volume.h"
#include "rendering/media/late_balls.h"

#include <memory_resource>
#include <vector>

namespace fx::render {

/// How a ball with a tile is drawn: axes of the tile and its place in the atlas. Layout of
/// shaders/blocks/block_chord.glsl.
struct BlockRecord
{
    /// xyz unit vector along world axes; w [1] radius of the block over the distance of the tile's eye, below
    /// 1, plus the depth of the middle of the content as a number of 1/127 radii from -1 radius on
    glm::vec4 right;
    glm::vec4 up; ///< xyz likewise; w [1/m2] one over the cross section at density 1
    /// x [texel] side of the tile; yz [texel] corner; w exposed light per unit of the tile, -1: the tile has
    /// no colors of its own
    glm::vec4 tile;
    /// x [1] extinction in the middle of its balls, on average, over that of one ball as large as the block
    glm::vec4 detail;
};
static_assert(sizeof(BlockRecord) == 64);

/// Settings of BlockWalk.
struct BlockWalkSettings
{
    /// [pixel] Diameter on the picture up to which a block is drawn as an impostor. From 0.8 of it on its
    /// content fades in.
    float maxPixels = 96.0f;
    float exposure = 1.0f; ///< [m2/cd]
    /// [1] Predicted root mean square error, in units of white, up to which a block is drawn as an impostor.
    /// From 0.8 of it on its content fades in. 0: not limited.
    float error = 0.0f;
    BlockErrors* errors = nullptr; ///< predictions; null: not limited
    /// Of an effect: beyond, blocks are drawn as impostors however large they are. An effect with more balls
    /// draws half of them at most because of the error of impostors.
    uint32_t maxBalls = 0;
    /// Of an effect: with more balls, blocks that are drawn as impostors cast shadows as single balls.
    uint32_t maxCasters = 65536;
};

/// Counters of the walks of a frame.
struct BlockWalkCounts
{
    uint32_t impostors = 0, culled = 0;
    uint32_t nonFinite = 0; ///< blocks and balls with a value that is not finite
};

/// Walks through the blocks of an effect.
class BlockWalk
{
public:
    /// @param height [pixel] of the picture
    BlockWalk(const CameraGeometry& camera, int height, BlockTiles& tiles,
              std::pmr::vector<GatheredBlob>& balls, std::pmr::vector<MediumCaster>& casters,
              std::pmr::vector<BlockRecord>& records);

    /// Appends all blocks of a solver to the lists.
    /// @param older its blocks in the older snapshot; may be null  @param t interpolation, 1 is the newer one
    /// @param place placement of the effect relative to the eye
    /// @param like values that all balls of the effect have in common
    /// @param detail of the field, from the coordinates of its blocks; may be without
    void run(const base::BlockGroups& groups, const BlockContents& contents, const base::SnapshotGroup* older,
             float t, float stepSeconds, double seconds, const base::Placement& place,
             const GatheredBlob& like, const BlobDetail& detail, const BlockWalkSettings& settings);

    const BlockWalkCounts& counts() const { return counts_; }

private:
    struct Level
    {
        base::BlockFrame frame;
        const base::SnapshotGroup* blocks = nullptr;
        uint32_t row = 0;
        float weight = 1.0f;
    };

    void visit(const base::BlockFrame& frame, uint32_t variant, float weight);
    GatheredBlob wholeBall(const base::BlockFrame& frame, const BlockContent& content, float weight,
                           const glm::vec3& center, float radius) const;
    void addWholeBall(const base::BlockFrame& frame, const BlockContent& content, float weight);
    void addImpostor(const base::BlockFrame& frame, const BlockContent& content, const Tile& tile,
                     float weight);
    void addBalls(const base::BlockFrame& frame, const base::SnapshotGroup& group, float weight,
                  uint32_t most);
    bool isNear(const base::BlockFrame& frame, float radius) const;
    float drawImpostor(const base::BlockFrame& frame, uint32_t variant, float weight, float share,
                       float pixels, bool isFull);
    void addDrawnCasters(const base::BlockFrame& frame, uint32_t variant, float weight);
    void addCaster(const glm::vec3& center, float radius, float crossSection);
    bool canCastBalls(const BlockContent& content) const;
    void addContentCasters(const base::BlockFrame& frame, const base::SnapshotGroup& group, float weight);
    void addBallCasters(const base::BlockFrame& frame, uint32_t variant);
    void addBlockCasters(const base::BlockFrame& frame, uint32_t variant, float weight);
    float leastRadius(const glm::vec3& center) const;
    float impostorShare(const base::BlockFrame& frame, float radius, float& outPixels) const;
    float shareByError(const base::BlockFrame& frame, TileRequest& io) const;

    const CameraGeometry& camera_;
    ViewVolume volume_;
    float pixelsPerSlope_;
    BlockTiles& tiles_;
    std::pmr::vector<GatheredBlob>& balls_;
    std::pmr::vector<MediumCaster>& casters_;
    std::pmr::vector<BlockRecord>& records_;
    BlockWalkCounts counts_;

    // of the effect that is walked through
    const base::BlockGroups* groups_ = nullptr;
    const BlockContents* contents_ = nullptr;
    const BlockWalkSettings* settings_ = nullptr;
    GatheredBlob like_{};
    uint64_t instance_ = 0;
    double seconds_ = 0.0;
    uint32_t effectBalls_ = 0;
    uint32_t contentCasters_ = 0; ///< balls of blocks that cast shadows because they are drawn
    uint32_t errorBalls_ = 0;     ///< up to which blocks become their content because of their error
    float back_ = 0.0f;           ///< [s] from the moment of the frame to the newer snapshot
    bool castsBalls_ = true;
};

} // namespace fx::render
